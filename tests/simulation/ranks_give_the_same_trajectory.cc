// A few steps of three discs in a Giesekus fluid, through a change of mesh: two
// processes together compute what each of them computes alone.

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/simulation.h>

#include "../tests.h"

using namespace Catena;

namespace
{
  struct Result
  {
    bool                        remeshed = false;
    unsigned int                elements = 0;
    dealii::Point<2>            centre;
    std::vector<RigidMotion<2>> motions;
  };



  Result
  compute(const MPI_Comm communicator)
  {
    LineOfParticlesParameters scene(3);
    scene.box.length = 20.;
    scene.box.height = 12.;

    SimulationParameters parameters;
    parameters.fluid.giesekus.weissenberg_number = 0.8;
    parameters.final_strain                      = 0.4;
    parameters.mesh.elements_on_equator          = 24;
    parameters.mesh.elements_across_gap          = 1;
    parameters.flow_solver.tolerance             = 1e-11;
    parameters.conformation_solver.tolerance     = 1e-12;

    Simulation<2> simulation(scene.scene<2>(), parameters, communicator);
    simulation.initialize();
    Result result;
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        if (std::abs(simulation.strain() - 0.16) < 1e-9)
          simulation.request_remesh();
        result.remeshed |= simulation.advance().remeshed;
      }
    const auto &now = simulation.current_state().now;
    result.elements = simulation.mesh().n_global_cells();
    result.centre   = now.configuration.centres[1];
    result.motions  = now.flow.motions;
    return result;
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](auto &claims) {
    const Result together = compute(MPI_COMM_WORLD),
                 alone    = compute(MPI_COMM_SELF);

    claims.holds("the mesh was changed on the way",
                 together.remeshed && alone.remeshed);
    claims.holds("the new mesh has as many elements",
                 together.elements == alone.elements);
    claims.at_most("a particle is at the same place",
                   together.centre.distance(alone.centre),
                   1e-9);
    for (unsigned int i = 0; i < 2; ++i)
      {
        const std::string who = i == 0 ? "middle" : "outer";
        const auto       &a = together.motions[i], &b = alone.motions[i];
        claims.at_most("the velocity of the " + who + " particle is the same",
                       (a.velocity - b.velocity).norm(),
                       1e-8);
        claims.near("so is its rotation",
                    a.angular_velocity[2],
                    b.angular_velocity[2],
                    1e-8);
      }
  });
}

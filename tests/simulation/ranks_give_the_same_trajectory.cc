// A few steps of three discs in a Giesekus fluid, through a change of mesh:
// the recorded numbers are the same on one rank and on two.

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/simulation.h>

#include <fstream>
#include <iomanip>

#include "../tests.h"

int
main(int argc, char **argv)
{
  using namespace Catena;

  return Tests::run(argc, argv, [](auto &claims) {
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

    Simulation<2> simulation(scene.scene<2>(), parameters, MPI_COMM_WORLD);
    simulation.initialize();
    bool remeshed = false;
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        if (std::abs(simulation.strain() - 0.16) < 1e-9)
          simulation.request_remesh();
        remeshed |= simulation.advance().remeshed;
      }
    claims.holds("the mesh was changed on the way", remeshed);

    const auto &now = simulation.current_state().now;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::ofstream numbers("output", std::ios::app);
        numbers << std::setprecision(8) << "elements "
                << simulation.mesh().n_global_cells() << "\nposition "
                << now.configuration.centres[1] << "\nvelocity "
                << now.flow.motions[1].velocity << "\nomega "
                << now.flow.motions[0].angular_velocity[2] << ' '
                << now.flow.motions[1].angular_velocity[2] << '\n';
      }
  });
}

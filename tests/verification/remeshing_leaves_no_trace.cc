// A pair held at the smallest gap in a fluid of high elasticity, on a rather
// coarse mesh: with a new mesh at a given instant and without one the
// velocities and the force in the contact are nearly the same, in the step with
// the new mesh and in those after it.

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/simulation.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;
using namespace Catena::Tests;



struct Instant
{
  double spin, velocity, force;
};



std::vector<Instant>
simulate(const bool remesh)
{
  LineOfParticlesParameters scene(2);
  scene.distance = 1.021;
  SimulationParameters parameters;
  auto                &giesekus       = parameters.fluid.giesekus;
  giesekus.weissenberg_number         = 3.;
  giesekus.mobility_parameter         = 0.01;
  giesekus.solvent_viscosity_ratio    = 0.1;
  parameters.final_strain             = 1.48;
  parameters.step_control.time_step   = 0.12;
  parameters.mesh.elements_on_equator = 48;
  parameters.mesh.elements_across_gap = 2;
  parameters.remesh_quality           = 1e-3;

  Simulation<3> simulation(scene.scene<3>(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  std::vector<Instant> instants;
  bool                 done = !remesh;
  while (simulation.strain() < parameters.final_strain - 1e-9)
    {
      const bool now = !done && simulation.strain() > 1. - 1e-9;
      if (now)
        simulation.request_remesh();
      done |= now;
      simulation.advance();
      const auto &flow = simulation.current_state().now.flow;
      if (simulation.strain() > 1. + 1e-9)
        instants.push_back({flow.motions[0].angular_velocity[2],
                            flow.motions[0].velocity.norm(),
                            flow.contact_forces.at(0) / (6. * numbers::PI)});
    }
  return instants;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const auto without = simulate(false), with = simulate(true);
    claims.holds("there is a force to compare", without.at(0).force > 0.1);
    const auto largest = [&](double Instant::*const quantity) {
      double difference = 0.;
      for (unsigned int i = 0; i < without.size(); ++i)
        difference =
          std::max(difference,
                   std::abs(with.at(i).*quantity - without.at(i).*quantity));
      return difference;
    };
    claims.at_most("spin [gamma]", largest(&Instant::spin), 2.5e-3);
    claims.at_most("velocity [a gamma]", largest(&Instant::velocity), 4e-3);
    claims.at_most("force [F_S]", largest(&Instant::force), 2e-3);
  });
}

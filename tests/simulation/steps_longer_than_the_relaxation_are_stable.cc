// Time steps of twice the relaxation time: the flow past a cylinder in a
// channel comes to the steady state of short steps, without a rejected step.
// (An explicit relaxation would be stable up to 4/3 of the relaxation time
// times the smallest eigenvalue of c.)

#include <catena/scene/confined_cylinder.h>
#include <catena/simulation/simulation.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

/// The drag after 40 relaxation times.
double
drag(const double time_step)
{
  ConfinedCylinderParameters channel;
  channel.length = 10.;
  SimulationParameters parameters;
  parameters.fluid.giesekus.weissenberg_number      = 0.1;
  parameters.fluid.giesekus.mobility_parameter      = 0.;
  parameters.fluid.giesekus.solvent_viscosity_ratio = 0.59;
  parameters.mesh.elements_on_equator               = 24;
  parameters.mesh.maximal_size                      = 1.;
  parameters.step_control.time_step                 = time_step;
  parameters.final_strain                           = 4.;

  Simulation<2> simulation(channel.scene(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  while (simulation.strain() < parameters.final_strain - 1e-9)
    simulation.advance();
  return simulation.current_state().now.flow.reactions.at(0);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const double expected = drag(0.035), value = drag(0.2);
    claims.near("drag with steps of two relaxation times",
                value,
                expected,
                1e-4 * std::abs(expected));
  });
}

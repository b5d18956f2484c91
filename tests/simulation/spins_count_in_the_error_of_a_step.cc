// A spin that jumps in one step turns the surface of its particle by more than
// was foreseen: the error of the step is the difference of the two angles, by
// Adams-Bashforth and by the trapezoidal rule, times the radius.

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;
using namespace Catena::Tests;



/// Error of the third of equal steps, in which a spin is changed by @p jump.
double
error_of_step(const double dt, const double jump)
{
  SimulationParameters parameters = three_discs_parameters(0.5, dt);
  parameters.fluid.model          = FluidParameters::Model::newtonian;
  Simulation<2> simulation(three_discs(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  simulation.advance();
  simulation.advance();
  simulation.inject_failures([&](const StepPart part, Level<2> &next) {
    if (part == StepPart::flow)
      next.flow.motions[1].angular_velocity[2] += jump;
  });
  return simulation.advance().error.local;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const double dt = 0.05, jump = 0.1;
    claims.at_most("without a jump", error_of_step(dt, 0.), 1e-4);
    // half of the jump, and 5/6 of the difference of the two rules
    claims.near("by the jump",
                error_of_step(dt, jump),
                5. / 12. * jump * dt,
                1e-4);
  });
}

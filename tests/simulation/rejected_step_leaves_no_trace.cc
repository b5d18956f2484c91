// A step in which discs come into contact is rejected: the contact is not held
// in the shorter step after it, in which it is not reached.

#include <catena/base/exceptions.h>

#include "../tests.h"

#include "../print.h"
#include "three_discs.h"

int
main(int argc, char **argv)
{
  using namespace Catena;

  return Tests::run(argc, argv, [](auto &claims) {
    auto parameters         = Tests::three_discs_parameters(0.4, 0.08);
    parameters.fluid.model  = FluidParameters::Model::newtonian;
    parameters.minimal_gap  = 0.0975;
    parameters.final_strain = 12.;

    Simulation<2> simulation(Tests::three_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();
    bool failed = false;
    simulation.inject_failures([&](const StepPart part, Level<2> &next) {
      const auto &forces = next.flow.contact_forces;
      if (part != StepPart::flow || failed || forces.empty() || forces[0] == 0.)
        return;
      failed = true;
      throw SolverError("as wanted");
    });

    const auto gap = [&]() {
      return 0.5 *
               simulation.current_state().now.configuration.centres[1].norm() -
             1. - parameters.minimal_gap;
    };
    double before = 0., now = gap(), dt = 0., rate = 0.;
    while (!failed)
      {
        rate   = dt > 0. ? (now - before) / dt : 0.;
        before = now;
        dt     = simulation.advance().dt;
        now    = gap();
      }
    Tests::print("gap ", before, ", then ", now, " in a step of ", dt);
    claims.at_least("the gap is still open", now, 5e-4);
    claims.near("it closes as fast as before",
                (now - before) / dt / rate,
                1.,
                0.2);
    while (simulation.contact_set().n_held() == 0)
      simulation.advance();
    claims.near("it is closed later", gap(), 0., 1e-12);
  });
}

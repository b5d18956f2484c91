// The control of the time step: with an error C dt^3 the steps settle where it
// is the tolerance, for any C; a bad step is rejected, a failed one halved,
// steps without a tolerance recover their length, one cut short does not
// shorten the next.

#include <catena/simulation/step_control.h>

#include "../tests.h"

using namespace Catena;
using namespace Catena::Tests;



StepControlParameters
controlled()
{
  StepControlParameters parameters;
  parameters.time_step    = 0.08;
  parameters.tolerance    = 4e-4;
  parameters.largest_step = 0.5;
  return parameters;
}



void
check_length(Claims &claims, const double dt_of_tolerance)
{
  const auto  parameters = controlled();
  StepControl control(parameters);
  const auto  error = [&](const double dt) {
    return StepError{parameters.tolerance * std::pow(dt / dt_of_tolerance, 3),
                     0.};
  };
  unsigned int n_rejected = 0, in_a_row = 0;
  double       growth = 0., last = 0.;
  for (unsigned int step = 0; step < 40; ++step)
    {
      in_a_row = 0;
      while (!control.accept(control.next_step(), error(control.next_step())))
        {
          ++in_a_row;
          ++n_rejected;
        }
      if (last > 0.)
        growth = std::max(growth, control.next_step() / last);
      last = control.next_step();
    }
  const std::string at = "tolerance at " + std::to_string(dt_of_tolerance);
  claims.near(at + ": length of the steps",
              control.next_step(),
              std::min(0.9 * dt_of_tolerance, parameters.largest_step),
              1e-6);
  claims.at_most(at + ": rejected steps", n_rejected, 4);
  claims.at_most(at + ": growth of a step", growth, 1.5 + 1e-12);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    for (const double dt : {0.01, 0.06, 0.2, 2.})
      check_length(claims, dt);

    StepControl cut(controlled());
    cut.accept(0.08, {4e-4 * std::pow(0.08 / 0.2, 3), 0.});
    const double wanted = cut.next_step();
    cut.accept(0.001, {4e-4 * std::pow(0.001 / 0.2, 3), 0.});
    claims.near("a step cut short leaves the next as it was",
                cut.next_step(),
                wanted,
                1e-14);

    StepControl steep(controlled());
    const auto  change_at = [](const double dt) { return dt * dt / 0.04; };
    for (unsigned int step = 0; step < 20; ++step)
      steep.accept(steep.next_step(), {0., change_at(steep.next_step())});
    claims.near("the log-conformation changes as much as is wanted",
                change_at(steep.next_step()),
                0.5,
                1e-6);

    StepControlParameters constant;
    constant.time_step = 0.08;
    StepControl fixed(constant);
    claims.holds("constant steps are never rejected",
                 fixed.accept(0.08, {1e9, 1e9}));
    claims.near("nor changed", fixed.next_step(), 0.08, 1e-14);
    claims.holds("a failed step is repeated", fixed.shorten(0.08));
    claims.near("with half of it", fixed.next_step(), 0.04, 1e-14);
    fixed.accept(0.04, {});
    fixed.accept(0.06, {});
    claims.near("and recovers", fixed.next_step(), 0.08, 1e-14);
    unsigned int n_failures = 0;
    while (fixed.shorten(fixed.next_step()))
      ++n_failures;
    claims.near("until there is no more hope", n_failures, 6, 0.);
  });
}

#include <catena/base/exceptions.h>
#include <catena/simulation/step_control.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr double safety = 0.9;
    /// error of a rejected step, in tolerances
    constexpr double too_much      = 2.;
    constexpr double wanted_change = StepError::failing_change / 2.;
    /// BDF2 is stable for steps that grow by up to 2.4
    constexpr double largest_growth = 1.5;
    constexpr double least_growth   = 0.3;
    /// in first steps
    constexpr double smallest_share = 1. / 64.;
  } // namespace



  void
  StepControlParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Time step",
                      time_step,
                      "Time step [1/gamma]; with a 'Tolerance' the first one.",
                      Patterns::Double());
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Error of a time step to which its length is controlled: "
                      "of the positions of the particles' surfaces [a], and of "
                      "the log-conformation in the mean over the elastic "
                      "energy. 0 for steps of constant length.",
                      Patterns::Double());
    prm.add_parameter("Largest time step",
                      largest_step,
                      "Upper limit of controlled time steps [1/gamma].",
                      Patterns::Double());
  }



  void
  StepControlParameters::check() const
  {
    require(time_step >= 1e-6 && time_step <= 1.,
            "Time/Time step",
            time_step,
            "choose a positive time step of at most 1, 0.08 is usual");
    require(tolerance == 0. || (tolerance >= 1e-12 && tolerance < 1.),
            "Time/Tolerance",
            tolerance,
            "choose 0 for constant steps or a tolerance below 1, 4e-4 is "
            "usual");
    require(tolerance == 0. ||
              (largest_step >= time_step && largest_step <= 1.),
            "Time/Largest time step",
            largest_step,
            "choose a value from 'Time/Time step' to 1");
  }



  StepControl::StepControl(const StepControlParameters &parameters)
    : parameters(parameters)
    , wanted(parameters.time_step)
  {}



  double
  StepControl::smallest_step() const
  {
    return smallest_share * parameters.time_step;
  }



  bool
  StepControl::accept(const double dt, const StepError &error)
  {
    const bool controlled = parameters.tolerance > 0.;
    double     factor     = may_grow ? largest_growth : 1.;
    // an error of zero wants an infinite step
    if (controlled)
      factor =
        std::clamp(std::min(safety *
                              std::cbrt(parameters.tolerance / error.local),
                            std::sqrt(wanted_change / error.largest_change)),
                   least_growth,
                   factor);
    if (controlled && error.local > too_much * parameters.tolerance &&
        dt > smallest_step())
      {
        wanted   = std::max(factor * dt, smallest_step());
        may_grow = false;
        return false;
      }
    // a good step cut short to end at a given instant does not shorten the next
    if (factor < 1. || factor * dt > wanted)
      wanted = factor * dt;
    may_grow = true;
    wanted =
      std::clamp(wanted,
                 smallest_step(),
                 controlled ? parameters.largest_step : parameters.time_step);
    return true;
  }



  bool
  StepControl::shorten(const double dt)
  {
    wanted   = dt / 2.;
    may_grow = false;
    return wanted >= smallest_step();
  }



  void
  StepControl::restart()
  {
    wanted = std::min(wanted, parameters.time_step);
  }
} // namespace Catena

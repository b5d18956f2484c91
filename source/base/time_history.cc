#include <catena/base/time_history.h>

#include <deal.II/base/exceptions.h>

namespace Catena
{
  bool
  TimeStep::has_previous() const
  {
    return previous_dt > 0.;
  }



  double
  TimeStep::ratio() const
  {
    Assert(dt > 0., dealii::ExcMessage("The time step must be positive."));
    Assert(previous_dt >= 0.,
           dealii::ExcMessage("The previous time step cannot be negative."));

    return has_previous() ? dt / previous_dt : 0.;
  }



  BdfCoefficients
  TimeStep::bdf() const
  {
    const double w = ratio();
    return {(1. + 2. * w) / (1. + w), -(1. + w), w * w / (1. + w)};
  }



  TwoLevelWeights
  TimeStep::extrapolation() const
  {
    const double w = ratio();
    return {1. + w, -w};
  }



  TwoLevelWeights
  TimeStep::adams_bashforth() const
  {
    const double w = ratio();
    return {1. + 0.5 * w, -0.5 * w};
  }



  TimeStep
  TimeStep::next(const double next_dt) const
  {
    return {next_dt, dt};
  }
} // namespace Catena

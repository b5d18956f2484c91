#include <catena/base/wall_clock.h>
#include <catena/simulation/checkpoint_clock.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  CheckpointClock::CheckpointClock(const CheckpointParameters &parameters,
                                   const MPI_Comm              communicator)
    : parameters(parameters)
    , communicator(communicator)
  {}



  bool
  CheckpointClock::is_due(const double strain) const
  {
    if (!parameters.enabled)
      return false;
    const double passed =
      Utilities::MPI::broadcast(communicator, wall_clock() - second);
    return (parameters.strain_interval > 0. &&
            interval(strain) > interval(last_strain)) ||
           (parameters.wall_time_interval > 0. &&
            passed > 60. * parameters.wall_time_interval);
  }



  void
  CheckpointClock::restart(const double strain)
  {
    last_strain = strain;
    second      = wall_clock();
  }



  double
  CheckpointClock::interval(const double strain) const
  {
    return std::floor(strain / parameters.strain_interval + 1e-9);
  }
} // namespace Catena

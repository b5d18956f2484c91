#ifndef catena_simulation_checkpoint_clock_h
#define catena_simulation_checkpoint_clock_h

#include <catena/simulation/checkpoint.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  /**
   * Tells when a checkpoint is due. Wall time is that of process 0.
   */
  class CheckpointClock
  {
  public:
    CheckpointClock(const CheckpointParameters &parameters,
                    const MPI_Comm              communicator);

    /// Has one of the intervals passed since restart()? All processes call.
    bool
    is_due(const double strain) const;

    /// A checkpoint of this strain is written, or was read.
    void
    restart(const double strain);

  private:
    const CheckpointParameters parameters;
    const MPI_Comm             communicator;
    double                     last_strain = 0., second = 0.;

    double
    interval(const double strain) const;
  };
} // namespace Catena

#endif

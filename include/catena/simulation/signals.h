#ifndef catena_simulation_signals_h
#define catena_simulation_signals_h

#include <deal.II/base/mpi.h>

#include <string>

namespace Catena
{
  /**
   * Notes signals that ask for a checkpoint, as long as it lives: SIGUSR1 to
   * go on, SIGTERM and SIGINT to end. A second SIGTERM or SIGINT ends the
   * program at once.
   */
  class Signals
  {
  public:
    Signals();
    ~Signals();

    Signals(const Signals &) = delete;
    Signals &
    operator=(const Signals &) = delete;

    /// What any process has been asked for.
    struct Request
    {
      bool checkpoint = false;
      /// number of the signal that asks to end, or 0
      int end = 0;
    };

    /// Requests since the last call. Collective.
    Request
    pending(const MPI_Comm communicator) const;

    /// "SIGTERM"
    static std::string
    name(const int signal);
  };
} // namespace Catena

#endif

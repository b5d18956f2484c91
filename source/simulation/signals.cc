#include <catena/simulation/signals.h>

#include <deal.II/base/mpi.h>

#include <csignal>
#include <vector>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    volatile std::sig_atomic_t checkpoint_wanted = 0, end_wanted = 0;

    void
    handle(const int signal, void (*handler)(int))
    {
      struct sigaction action = {};
      action.sa_handler       = handler;
      action.sa_flags         = SA_RESTART;
      sigaction(signal, &action, nullptr);
    }



    extern "C" void
    note_signal(const int signal)
    {
      if (signal == SIGUSR1)
        checkpoint_wanted = 1;
      else if (end_wanted)
        {
          handle(signal, SIG_DFL);
          std::raise(signal);
        }
      else
        end_wanted = signal;
    }
  } // namespace



  Signals::Signals()
  {
    checkpoint_wanted = 0;
    end_wanted        = 0;
    for (const int signal : {SIGTERM, SIGINT, SIGUSR1})
      handle(signal, note_signal);
  }



  Signals::~Signals()
  {
    for (const int signal : {SIGTERM, SIGINT, SIGUSR1})
      handle(signal, SIG_DFL);
  }



  Signals::Request
  Signals::pending(const MPI_Comm communicator) const
  {
    const int checkpoint = checkpoint_wanted, end = end_wanted;
    if (checkpoint)
      checkpoint_wanted = 0;
    std::vector<int> wanted = {checkpoint, end};
    Utilities::MPI::max(wanted, communicator, wanted);
    return {wanted[0] > 0 || wanted[1] > 0, wanted[1]};
  }



  std::string
  Signals::name(const int signal)
  {
    return signal == SIGTERM ? "SIGTERM" :
           signal == SIGINT  ? "SIGINT" :
                               "signal " + std::to_string(signal);
  }
} // namespace Catena

#include <catena/base/all_arrive.h>

#include <chrono>
#include <thread>

namespace Catena
{
  namespace
  {
    constexpr std::chrono::seconds patience(5);
  }



  bool
  all_arrive(const MPI_Comm communicator)
  {
    MPI_Request request;
    int         done = 0;
    MPI_Ibarrier(communicator, &request);
    const auto deadline = std::chrono::steady_clock::now() + patience;
    do
      {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (!done)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    while (!done && std::chrono::steady_clock::now() < deadline);
    return done;
  }
} // namespace Catena

#ifndef catena_base_all_arrive_h
#define catena_base_all_arrive_h

#include <deal.II/base/mpi.h>

namespace Catena
{
  /**
   * For a process that has failed: do all processes get here within a few
   * seconds? If not, the others know nothing of the failure and would wait
   * forever for this one, which must not call anything collective any more.
   */
  bool
  all_arrive(const MPI_Comm communicator);
} // namespace Catena

#endif

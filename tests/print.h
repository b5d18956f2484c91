#ifndef catena_tests_print_h
#define catena_tests_print_h

#include <deal.II/base/mpi.h>

#include <iostream>

namespace Catena
{
  namespace Tests
  {
    /// A line with numbers behind the claims; the first process prints it.
    template <typename... Items>
    void
    print(const Items &...items)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          (std::cout << ... << items);
          std::cout << std::endl;
        }
    }
  } // namespace Tests
} // namespace Catena

#endif

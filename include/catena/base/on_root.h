#ifndef catena_base_on_root_h
#define catena_base_on_root_h

#include <deal.II/base/mpi.h>

#include <vector>

namespace Catena
{
  /// The values of all ranks, one rank after the other, on rank 0; none on the
  /// others. Collective.
  template <typename Number>
  std::vector<Number>
  on_root(const Number *values, const int n_values, const MPI_Comm communicator)
  {
    using namespace dealii::Utilities::MPI;
    const MPI_Datatype type = mpi_type_id_for_type<Number>;

    std::vector<int> counts(n_mpi_processes(communicator)),
      offsets(counts.size(), 0);
    MPI_Gather(
      &n_values, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
    for (unsigned int r = 1; r < counts.size(); ++r)
      offsets[r] = offsets[r - 1] + counts[r - 1];
    std::vector<Number> result;
    if (this_mpi_process(communicator) == 0)
      result.resize(offsets.back() + counts.back());
    MPI_Gatherv(values,
                n_values,
                type,
                result.data(),
                counts.data(),
                offsets.data(),
                type,
                0,
                communicator);
    return result;
  }



  template <typename Number>
  std::vector<Number>
  on_root(const std::vector<Number> &values, const MPI_Comm communicator)
  {
    return on_root(values.data(), values.size(), communicator);
  }
} // namespace Catena

#endif

#include <catena/base/replicated.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  std::vector<double>
  replicate(const VectorType &block)
  {
    std::vector<double> values(block.size(), 0.);
    for (const auto i : block.locally_owned_elements())
      values[i] = block(i);
    Utilities::MPI::sum(values, block.get_mpi_communicator(), values);
    return values;
  }



  void
  set_replicated(VectorType &block, const std::vector<double> &values)
  {
    for (const auto i : block.locally_owned_elements())
      block(i) = values[i];
  }
} // namespace Catena

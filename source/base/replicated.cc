#include <catena/base/replicated.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  template <typename Vector>
  std::vector<double>
  replicate(const Vector &block)
  {
    std::vector<double> values(block.size(), 0.);
    for (const auto i : block.locally_owned_elements())
      values[i] = block(i);
    Utilities::MPI::sum(values, block.get_mpi_communicator(), values);
    return values;
  }



  template <typename Vector>
  void
  set_replicated(Vector &block, const std::vector<double> &values)
  {
    for (const auto i : block.locally_owned_elements())
      block(i) = values[i];
  }



  template std::vector<double>
  replicate(const VectorType &);
  template std::vector<double>
  replicate(const FastVectorType &);
  template void
  set_replicated(VectorType &, const std::vector<double> &);
  template void
  set_replicated(FastVectorType &, const std::vector<double> &);
} // namespace Catena

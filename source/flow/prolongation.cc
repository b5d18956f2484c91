#include <catena/flow/prolongation.h>

namespace Catena
{
  Prolongation::Prolongation(const SparseRows &global_rows,
                             const dealii::Utilities::MPI::Partitioner &nodes)
    : rows(global_rows)
  {
    for (unsigned int &column : rows.columns)
      column = nodes.global_to_local(column);
  }



  void
  Prolongation::add_product(Lanes *fine, const Lanes *coarse) const
  {
    const unsigned int *column = rows.columns.data();
    const float        *value  = rows.values.data();
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        Lanes sum = fine[i];
        for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
          sum += *value++ * coarse[*column++];
        fine[i] = sum;
      }
  }



  void
  Prolongation::add_transposed_product(Lanes *coarse, const Lanes *fine) const
  {
    const unsigned int *column = rows.columns.data();
    const float        *value  = rows.values.data();
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const Lanes x = fine[i];
        for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
          coarse[*column++] += *value++ * x;
      }
  }
} // namespace Catena

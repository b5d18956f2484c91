#include <catena/flow/block_matrix.h>

#include <algorithm>
#include <array>

namespace Catena
{
  using namespace dealii;

  template <int n_rows>
  BlockMatrix<n_rows>::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : block_pattern(std::move(pattern))
    , entries(std::size_t(block_pattern->n_blocks()) * n_rows)
  {
    const auto &nodes = *block_pattern->column_nodes();
    if (nodes.n_mpi_processes() > 1)
      ghosted_src.reinit(nodes.locally_owned_range(),
                         nodes.ghost_indices(),
                         nodes.get_mpi_communicator());
  }



  template <int n_rows>
  void
  BlockMatrix<n_rows>::clear()
  {
    std::fill(entries.begin(), entries.end(), 0.f);
  }



  /// The values of the columns by their local numbers.
  template <int n_rows>
  const float *
  BlockMatrix<n_rows>::column_values(const FastVectorType &src) const
  {
    if (block_pattern->column_nodes()->n_mpi_processes() == 1)
      return src.begin();
    ghosted_src.copy_locally_owned_data_from(src);
    ghosted_src.update_ghost_values();
    return ghosted_src.begin();
  }



  template <int n_rows>
  template <typename Action>
  void
  BlockMatrix<n_rows>::multiply(const FastVectorType &src,
                                const Action         &action) const
  {
    const float *const        x       = column_values(src);
    const unsigned int *const columns = block_pattern->local_columns();
    const float              *entry   = entries.data();
    for (unsigned int row = 0; row < block_pattern->n_rows(); ++row)
      {
        std::array<float, n_rows> sums = {};
        for (unsigned int k = block_pattern->row_start(row);
             k < block_pattern->row_start(row + 1);
             ++k, entry += n_rows)
          for (unsigned int r = 0; r < n_rows; ++r)
            sums[r] += entry[r] * x[columns[k]];
        for (unsigned int r = 0; r < n_rows; ++r)
          action(n_rows * row + r, sums[r]);
      }
  }



  template <int n_rows>
  void
  BlockMatrix<n_rows>::vmult(FastVectorType       &dst,
                             const FastVectorType &src) const
  {
    float *const y = dst.begin();
    multiply(src,
             [y](const unsigned int row, const float sum) { y[row] = sum; });
  }



  template <int n_rows>
  void
  BlockMatrix<n_rows>::residual(FastVectorType       &dst,
                                const FastVectorType &src,
                                const FastVectorType &rhs) const
  {
    float *const       y = dst.begin();
    const float *const b = rhs.begin();
    multiply(src, [y, b](const unsigned int row, const float sum) {
      y[row] = b[row] - sum;
    });
  }



  template <int n_rows>
  float
  BlockMatrix<n_rows>::el(const unsigned int i, const unsigned int j) const
  {
    const unsigned int row = block_pattern->row(i / n_rows);
    Assert(row != BlockPattern::absent, ExcInternalError());
    return block(block_pattern->row_start(row) +
                 block_pattern->offset(row, j))[i % n_rows];
  }



  template class BlockMatrix<1>;
  template class BlockMatrix<2>;
  template class BlockMatrix<3>;
} // namespace Catena

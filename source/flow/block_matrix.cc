#include <catena/base/node_dofs.h>
#include <catena/flow/block_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <experimental/simd>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    namespace simd = std::experimental;

    /// A column of a block in double precision, and what comes after it.
    constexpr unsigned int width = 4;
    using Doubles = simd::simd<double, simd::simd_abi::deduce_t<double, width>>;



    /// Row by row, the product of the blocks of a node with @p x.
    template <int n_rows, int n_columns, typename Number>
    inline std::array<double, n_rows>
    node_product(const Number       *entries,
                 const unsigned int *column,
                 const unsigned int *end,
                 const double       *x)
    {
      std::array<double, n_rows> product = {};
      if constexpr (n_rows == 1)
        {
          std::array<double, n_columns> sums = {};
          for (; column != end; ++column, entries += n_columns)
            for (unsigned int c = 0; c < n_columns; ++c)
              sums[c] += entries[c] * x[n_columns * *column + c];
          for (unsigned int c = 0; c < n_columns; ++c)
            product[0] += sums[c];
        }
      else
        {
          std::array<Doubles, n_columns> sums = {};
          for (; column != end; ++column)
            for (unsigned int c = 0; c < n_columns; ++c, entries += n_rows)
              sums[c] += Doubles(entries, simd::element_aligned) *
                         x[n_columns * *column + c];
          for (unsigned int c = 1; c < n_columns; ++c)
            sums[0] += sums[c];
          for (unsigned int r = 0; r < n_rows; ++r)
            product[r] = sums[0][r];
        }
      return product;
    }

  } // namespace



  template <int n_rows, int n_columns, typename Number>
  BlockMatrix<n_rows, n_columns, Number>::BlockMatrix(
    std::shared_ptr<const BlockPattern> pattern)
    : block_pattern(std::move(pattern))
    // the last column is read with numbers beyond
    , entries(std::size_t(block_pattern->n_blocks()) * n_rows * n_columns +
              width)
  {
    const auto &nodes = block_pattern->column_nodes();
    if (nodes.n_mpi_processes() > 1)
      ghosted_src.reinit(node_dofs(nodes.locally_owned_range(), n_columns),
                         node_dofs(nodes.ghost_indices(), n_columns),
                         nodes.get_mpi_communicator());
  }



  template <int n_rows, int n_columns, typename Number>
  void
  BlockMatrix<n_rows, n_columns, Number>::clear()
  {
    std::fill(entries.begin(), entries.end(), Number());
  }



  template <int n_rows, int n_columns, typename Number>
  template <typename OtherNumber>
  BlockMatrix<n_rows, n_columns, Number> &
  BlockMatrix<n_rows, n_columns, Number>::operator=(
    const BlockMatrix<n_rows, n_columns, OtherNumber> &other)
  {
    if (block_pattern != other.shared_pattern())
      *this = BlockMatrix(other.shared_pattern());
    std::copy_n(other.block(0), entries.size(), entries.begin());
    return *this;
  }



  /// The values of the columns by their local numbers.
  template <int n_rows, int n_columns, typename Number>
  const double *
  BlockMatrix<n_rows, n_columns, Number>::column_values(
    const VectorType &src) const
  {
    if (block_pattern->column_nodes().n_mpi_processes() == 1)
      return src.begin();
    ghosted_src.copy_locally_owned_data_from(src);
    ghosted_src.update_ghost_values();
    return ghosted_src.begin();
  }



  template <int n_rows, int n_columns, typename Number>
  template <bool add>
  void
  BlockMatrix<n_rows, n_columns, Number>::multiply(VectorType       &dst,
                                                   const VectorType &src) const
  {
    const double *const       x       = column_values(src);
    const unsigned int *const columns = block_pattern->local_columns();
    double                   *y       = dst.begin();
    for (unsigned int row = 0; row < block_pattern->n_rows(); ++row)
      {
        const unsigned int begin = block_pattern->row_start(row),
                           end   = block_pattern->row_start(row + 1);
        const auto product       = node_product<n_rows, n_columns>(block(begin),
                                                             columns + begin,
                                                             columns + end,
                                                             x);
        for (unsigned int r = 0; r < n_rows; ++r, ++y)
          *y = add ? *y + product[r] : product[r];
      }
  }



  template <int n_rows, int n_columns, typename Number>
  void
  BlockMatrix<n_rows, n_columns, Number>::vmult(VectorType       &dst,
                                                const VectorType &src) const
  {
    multiply<false>(dst, src);
  }



  template <int n_rows, int n_columns, typename Number>
  void
  BlockMatrix<n_rows, n_columns, Number>::vmult_add(VectorType       &dst,
                                                    const VectorType &src) const
  {
    multiply<true>(dst, src);
  }



  template <int n_rows, int n_columns, typename Number>
  double
  BlockMatrix<n_rows, n_columns, Number>::frobenius_norm() const
  {
    double square = 0.;
    for (const Number entry : entries)
      square += entry * entry;
    return std::sqrt(Utilities::MPI::sum(
      square, block_pattern->column_nodes().get_mpi_communicator()));
  }



  template class BlockMatrix<1, 1, double>;
  template class BlockMatrix<1, 2, double>;
  template class BlockMatrix<1, 3, double>;
  template class BlockMatrix<2, 1, double>;
  template class BlockMatrix<3, 1, double>;
  template class BlockMatrix<2, 2, double>;
  template class BlockMatrix<3, 3, double>;

  template class BlockMatrix<1, 2, float>;
  template class BlockMatrix<1, 3, float>;
  template class BlockMatrix<2, 1, float>;
  template class BlockMatrix<3, 1, float>;
  template class BlockMatrix<2, 2, float>;
  template class BlockMatrix<3, 3, float>;

  template BlockMatrix<1, 2, float> &
  BlockMatrix<1, 2, float>::operator=(const BlockMatrix<1, 2, double> &);
  template BlockMatrix<1, 3, float> &
  BlockMatrix<1, 3, float>::operator=(const BlockMatrix<1, 3, double> &);
  template BlockMatrix<2, 1, float> &
  BlockMatrix<2, 1, float>::operator=(const BlockMatrix<2, 1, double> &);
  template BlockMatrix<3, 1, float> &
  BlockMatrix<3, 1, float>::operator=(const BlockMatrix<3, 1, double> &);
  template BlockMatrix<2, 2, float> &
  BlockMatrix<2, 2, float>::operator=(const BlockMatrix<2, 2, double> &);
  template BlockMatrix<3, 3, float> &
  BlockMatrix<3, 3, float>::operator=(const BlockMatrix<3, 3, double> &);
} // namespace Catena

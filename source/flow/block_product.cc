#include <catena/flow/block_product.h>

#include <array>

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
    template <int n_rows, int n_columns>
    inline std::array<double, n_rows>
    node_product(const float        *entries,
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
              sums[c] += entries[c] * x[*column + c];
          for (unsigned int c = 0; c < n_columns; ++c)
            product[0] += sums[c];
        }
      else
        {
          std::array<Doubles, n_columns> sums = {};
          for (; column != end; ++column)
            for (unsigned int c = 0; c < n_columns; ++c, entries += n_rows)
              sums[c] +=
                Doubles(entries, simd::element_aligned) * x[*column + c];
          for (unsigned int c = 1; c < n_columns; ++c)
            sums[0] += sums[c];
          for (unsigned int r = 0; r < n_rows; ++r)
            product[r] = sums[0][r];
        }
      return product;
    }
  } // namespace



  template <int n_rows, int n_columns>
  BlockProduct<n_rows, n_columns>::BlockProduct(
    const TrilinosWrappers::SparseMatrix &matrix)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    int                    *starts, *indices;
    double                 *values;
    const int error = epetra.ExtractCrsDataPointers(starts, indices, values);
    AssertThrow(error == 0, ExcInternalError());
    exact_entries = values;
    // the last column is read with numbers beyond
    entries.resize(epetra.NumMyNonzeros() + width);

    const IndexSet owned = matrix.locally_owned_domain_indices();
    IndexSet       ghosts(owned.size());
    for (int k = 0; k < epetra.NumMyCols(); ++k)
      if (!owned.is_element(epetra.ColMap().GID(k)))
        ghosts.add_index(epetra.ColMap().GID(k));
    ghosted_src.reinit(owned, ghosts, matrix.get_mpi_communicator());

    std::vector<unsigned int> places(epetra.NumMyCols());
    for (unsigned int k = 0; k < places.size(); ++k)
      places[k] =
        ghosted_src.get_partitioner()->global_to_local(epetra.ColMap().GID(k));
    for (int row = 0; row < epetra.NumMyRows(); row += n_rows)
      {
        Assert(starts[row + n_rows] - starts[row] ==
                 n_rows * (starts[row + 1] - starts[row]),
               ExcInternalError());
        for (int k = starts[row]; k < starts[row + 1]; k += n_columns)
          columns.push_back(places[indices[k]]);
        row_starts.push_back(columns.size());
      }
  }



  template <int n_rows, int n_columns>
  void
  BlockProduct<n_rows, n_columns>::update()
  {
    const double *exact = exact_entries;
    float        *next  = entries.data();
    for (unsigned int node = 0; node + 1 < row_starts.size(); ++node)
      {
        const unsigned int length =
          n_columns * (row_starts[node + 1] - row_starts[node]);
        for (unsigned int k = 0; k < length; ++k)
          for (unsigned int r = 0; r < n_rows; ++r)
            *next++ = exact[r * length + k];
        exact += n_rows * length;
      }
  }



  /// The values of the columns in the order of the matrix.
  template <int n_rows, int n_columns>
  const double *
  BlockProduct<n_rows, n_columns>::column_values(const VectorType &src) const
  {
    if (ghosted_src.get_partitioner()->n_mpi_processes() == 1)
      return src.begin();
    ghosted_src.copy_locally_owned_data_from(src);
    ghosted_src.update_ghost_values();
    return ghosted_src.begin();
  }



  template <int n_rows, int n_columns>
  template <bool add>
  void
  BlockProduct<n_rows, n_columns>::multiply(VectorType       &dst,
                                            const VectorType &src) const
  {
    const double *const x = column_values(src);
    double             *y = dst.begin();
    for (unsigned int node = 0; node + 1 < row_starts.size(); ++node)
      {
        const std::size_t begin = row_starts[node], end = row_starts[node + 1];
        const auto        product =
          node_product<n_rows, n_columns>(entries.data() +
                                            n_rows * n_columns * begin,
                                          columns.data() + begin,
                                          columns.data() + end,
                                          x);
        for (unsigned int r = 0; r < n_rows; ++r, ++y)
          *y = add ? *y + product[r] : product[r];
      }
  }



  template <int n_rows, int n_columns>
  void
  BlockProduct<n_rows, n_columns>::vmult(VectorType       &dst,
                                         const VectorType &src) const
  {
    multiply<false>(dst, src);
  }



  template <int n_rows, int n_columns>
  void
  BlockProduct<n_rows, n_columns>::vmult_add(VectorType       &dst,
                                             const VectorType &src) const
  {
    multiply<true>(dst, src);
  }



  template class BlockProduct<1, 2>;
  template class BlockProduct<1, 3>;
  template class BlockProduct<2, 1>;
  template class BlockProduct<3, 1>;
  template class BlockProduct<2, 2>;
  template class BlockProduct<3, 3>;
} // namespace Catena

#include <catena/flow/block_product.h>

#include <algorithm>
#include <cstring>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int width = 8;
    using Singles = float __attribute__((vector_size(4 * width)));
    using Doubles = double __attribute__((vector_size(8 * width)));

    template <typename Values, typename Number>
    inline Values
    at(const Number *p)
    {
      Values values;
      std::memcpy(&values, p, sizeof(Values));
      return values;
    }



    /// The sum of the products of @p n numbers, several at a time.
    inline double
    dot(const float *a, const double *x, const unsigned int n)
    {
      Doubles      sums = {};
      unsigned int k    = 0;
      for (; k + width <= n; k += width)
        sums += __builtin_convertvector(at<Singles>(a + k), Doubles) *
                at<Doubles>(x + k);
      double sum = 0.;
      for (unsigned int i = 0; i < width; ++i)
        sum += sums[i];
      for (; k < n; ++k)
        sum += a[k] * x[k];
      return sum;
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
    entries.resize(epetra.NumMyNonzeros());

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
    int longest = 0;
    for (int row = 0; row < epetra.NumMyRows(); row += n_rows)
      {
        Assert(starts[row + n_rows] - starts[row] ==
                 n_rows * (starts[row + 1] - starts[row]),
               ExcInternalError());
        for (int k = starts[row]; k < starts[row + 1]; k += n_columns)
          columns.push_back(places[indices[k]]);
        row_starts.push_back(columns.size());
        longest = std::max(longest, starts[row + 1] - starts[row]);
      }
    row_values.resize(longest);
  }



  template <int n_rows, int n_columns>
  void
  BlockProduct<n_rows, n_columns>::update()
  {
    std::copy(exact_entries, exact_entries + entries.size(), entries.begin());
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
    const double *const x      = column_values(src);
    const float        *values = entries.data();
    double             *y      = dst.begin();
    for (unsigned int node = 0; node + 1 < row_starts.size(); ++node)
      {
        // the values that belong to a row, one after the other
        double *next = row_values.data();
        for (unsigned int k = row_starts[node]; k < row_starts[node + 1]; ++k)
          for (unsigned int c = 0; c < n_columns; ++c)
            *next++ = x[columns[k] + c];
        const unsigned int length = next - row_values.data();

        for (unsigned int r = 0; r < n_rows; ++r, ++y, values += length)
          {
            const double sum = dot(values, row_values.data(), length);
            *y               = add ? *y + sum : sum;
          }
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

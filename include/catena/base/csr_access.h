#ifndef catena_base_csr_access_h
#define catena_base_csr_access_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/index_set.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <vector>

namespace Catena
{
  /**
   * Fast addition into the locally owned rows of an assembled Trilinos
   * matrix: the entries are found by bisection in the rows' sorted columns
   * and added without going through global indices.
   *
   * Valid until the matrix gets another sparsity pattern.
   */
  class CsrAccess
  {
  public:
    /// No row or column of this rank.
    static constexpr int absent = -1;

    CsrAccess() = default;

    /**
     * @param rows, columns the global indices that will be looked up
     */
    CsrAccess(const dealii::TrilinosWrappers::SparseMatrix &matrix,
              const dealii::IndexSet                       &rows,
              const dealii::IndexSet                       &columns)
    {
      const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
      const int               error =
        epetra.ExtractCrsDataPointers(row_starts, column_indices, entries);
      AssertThrow(error == 0, dealii::ExcInternalError());
      local_rows.assign(rows.size(), absent);
      for (const auto i : rows)
        local_rows[i] = epetra.RowMap().LID(static_cast<int>(i));
      local_columns.assign(columns.size(), absent);
      for (const auto j : columns)
        local_columns[j] = epetra.ColMap().LID(static_cast<int>(j));
    }

    int
    row(const unsigned int global) const
    {
      return local_rows[global];
    }

    int
    column(const unsigned int global) const
    {
      return local_columns[global];
    }

    /// Where in the row @p column is stored.
    int
    offset(const int row, const int column) const
    {
      const int *begin = column_indices + row_starts[row];
      const int *end   = column_indices + row_starts[row + 1];
      const int *it    = std::lower_bound(begin, end, column);
      Assert(it != end && *it == column, dealii::ExcInternalError());
      return static_cast<int>(it - begin);
    }

    /// The values of a row.
    double *
    values(const int row) const
    {
      return entries + row_starts[row];
    }

    void
    add(const int row, const int column, const double value) const
    {
      values(row)[offset(row, column)] += value;
    }

    /// Multiply the entries of a row.
    void
    scale(const int row, const double factor) const
    {
      for (int k = row_starts[row]; k < row_starts[row + 1]; ++k)
        entries[k] *= factor;
    }

  private:
    int             *row_starts     = nullptr;
    int             *column_indices = nullptr;
    double          *entries        = nullptr;
    std::vector<int> local_rows, local_columns;
  };
} // namespace Catena

#endif

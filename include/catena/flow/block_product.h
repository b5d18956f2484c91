#ifndef catena_flow_block_product_h
#define catena_flow_block_product_h

#include <catena/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * Products of a Trilinos matrix between vector fields of @p n_rows and
   * @p n_columns components, one degree of freedom after the other at each
   * node. The rows of a node have the same columns, and a column's node is
   * there with all its components: there is one index for a block. The entries
   * are kept in single precision, sums are in double. Bound by memory as it is,
   * that takes half the time of the matrix' own product; what it is used for
   * has to make up for the difference.
   *
   * Valid until the matrix gets another sparsity pattern.
   */
  template <int n_rows, int n_columns>
  class BlockProduct
  {
  public:
    BlockProduct() = default;

    explicit BlockProduct(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    /// Take over the entries that the matrix has now.
    void
    update();

    /// dst = A src
    void
    vmult(VectorType &dst, const VectorType &src) const;

    /// dst += A src
    void
    vmult_add(VectorType &dst, const VectorType &src) const;

  private:
    /// where Trilinos keeps the entries
    const double *exact_entries = nullptr;
    /// by block, column by column
    std::vector<float> entries;
    /// by node, the range of its blocks; by block, where its column starts
    std::vector<unsigned int> row_starts = {0}, columns;

    /// has the ghosts of the columns
    mutable VectorType ghosted_src;

    const double *
    column_values(const VectorType &src) const;

    template <bool add>
    void
    multiply(VectorType &dst, const VectorType &src) const;
  };
} // namespace Catena

#endif

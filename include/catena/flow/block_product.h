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
   * there with all its components: there is one index for a block, and the
   * entries are read where Trilinos keeps them. Bound by memory as it is, that
   * is faster than the matrix' own product.
   *
   * Valid until the matrix gets another sparsity pattern.
   */
  template <int n_rows, int n_columns>
  class BlockProduct
  {
  public:
    BlockProduct() = default;

    explicit BlockProduct(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    /// dst = A src
    void
    vmult(VectorType &dst, const VectorType &src) const;

    /// dst += A src
    void
    vmult_add(VectorType &dst, const VectorType &src) const;

  private:
    const double *entries = nullptr;
    /// by node, the range of its blocks; by block, where its column starts
    std::vector<unsigned int> row_starts = {0}, columns;

    /// has the ghosts of the columns
    mutable VectorType          ghosted_src;
    mutable std::vector<double> row_values;

    const double *
    column_values(const VectorType &src) const;

    template <bool add>
    void
    multiply(VectorType &dst, const VectorType &src) const;
  };
} // namespace Catena

#endif

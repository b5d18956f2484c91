#ifndef catena_flow_rigid_product_h
#define catena_flow_rigid_product_h

#include <catena/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * Products of a Trilinos matrix C that has one column for each rigid-body
   * unknown, and entries in the few rows next to the particles only: the other
   * rows are not looked at. The unknowns are the same on every rank. The
   * entries are read where Trilinos keeps them.
   *
   * Valid until the matrix gets another sparsity pattern.
   */
  class RigidProduct
  {
  public:
    RigidProduct() = default;

    explicit RigidProduct(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    /// dst += C motions
    void
    vmult_add(VectorType &dst, const std::vector<double> &motions) const;

    /// forces += C^T src, the part of this rank
    void
    Tvmult_add(std::vector<double> &forces, const VectorType &src) const;

  private:
    const double *entries = nullptr;
    /// the rows that have entries, their ranges of entries, and their columns
    std::vector<unsigned int> rows, starts = {0}, columns;
  };
} // namespace Catena

#endif

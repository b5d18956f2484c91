#ifndef catena_flow_block_matrix_h
#define catena_flow_block_matrix_h

#include <catena/base/types.h>
#include <catena/flow/block_pattern.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * A matrix between vector fields of @p n_rows and @p n_columns components,
   * the degrees of freedom of a node one after the other. For each pair of
   * coupled nodes there is one block and one index, and what a cell adds to it
   * lies side by side.
   *
   * Products are bound by memory: with entries in single precision they take
   * half the time. Sums are in double precision in any case.
   */
  template <int n_rows, int n_columns, typename Number>
  class BlockMatrix
  {
  public:
    BlockMatrix() = default;

    /// All entries are zero.
    explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

    const BlockPattern &
    pattern() const
    {
      return *block_pattern;
    }

    std::shared_ptr<const BlockPattern>
    shared_pattern() const
    {
      return block_pattern;
    }

    /// The entries of a block of the pattern, column by column.
    Number *
    block(const unsigned int k)
    {
      return entries.data() + std::size_t(k) * n_rows * n_columns;
    }

    const Number *
    block(const unsigned int k) const
    {
      return entries.data() + std::size_t(k) * n_rows * n_columns;
    }

    /// Block number @p offset of a row.
    Number *
    block(const unsigned int row, const unsigned int offset)
    {
      return block(block_pattern->row_start(row) + offset);
    }

    /// Set all entries to zero.
    void
    clear();

    /// Take over pattern and entries.
    template <typename OtherNumber>
    BlockMatrix &
    operator=(const BlockMatrix<n_rows, n_columns, OtherNumber> &other);

    /// dst = A src
    void
    vmult(VectorType &dst, const VectorType &src) const;

    /// dst += A src
    void
    vmult_add(VectorType &dst, const VectorType &src) const;

    /// That of the rows of all ranks.
    double
    frobenius_norm() const;

  private:
    std::shared_ptr<const BlockPattern> block_pattern;
    std::vector<Number>                 entries;

    /// has the ghosts of the columns, if there are other ranks
    mutable VectorType ghosted_src;

    const double *
    column_values(const VectorType &src) const;

    template <bool add>
    void
    multiply(VectorType &dst, const VectorType &src) const;
  };
} // namespace Catena

#endif

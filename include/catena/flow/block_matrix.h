#ifndef catena_flow_block_matrix_h
#define catena_flow_block_matrix_h

#include <catena/base/types.h>
#include <catena/flow/block_pattern.h>

#include <deal.II/base/subscriptor.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * A matrix from a scalar field to one of @p n_rows components, the degrees of
   * freedom of a node one after the other. For each pair of coupled nodes there
   * is one block and one index, and what a cell adds to it lies side by side.
   *
   * Products are bound by memory: all is in single precision.
   */
  template <int n_rows>
  class BlockMatrix : public dealii::Subscriptor
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

    /// The entries of a block of the pattern.
    float *
    block(const unsigned int k)
    {
      return entries.data() + std::size_t(k) * n_rows;
    }

    const float *
    block(const unsigned int k) const
    {
      return entries.data() + std::size_t(k) * n_rows;
    }

    /// Block number @p offset of a row.
    float *
    block(const unsigned int row, const unsigned int offset)
    {
      return block(block_pattern->row_start(row) + offset);
    }

    /// Set all entries to zero.
    void
    clear();

    /// dst = A src
    void
    vmult(FastVectorType &dst, const FastVectorType &src) const;

    /// dst = rhs - A src
    void
    residual(FastVectorType       &dst,
             const FastVectorType &src,
             const FastVectorType &rhs) const;

    /// Number of rows of all ranks, of a matrix from nodes to the same nodes.
    std::size_t
    m() const
    {
      return n_rows * block_pattern->column_nodes()->size();
    }

    /// An entry, which is in the pattern and in a row of this rank.
    float
    el(const unsigned int i, const unsigned int j) const;

  private:
    std::shared_ptr<const BlockPattern> block_pattern;
    std::vector<float>                  entries;

    /// has the ghosts of the columns, if there are other ranks
    mutable FastVectorType ghosted_src;

    const float *
    column_values(const FastVectorType &src) const;

    /// Call @p action with each row, of a component, and its product.
    template <typename Action>
    void
    multiply(const FastVectorType &src, const Action &action) const;
  };
} // namespace Catena

#endif

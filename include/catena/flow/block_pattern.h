#ifndef catena_flow_block_pattern_h
#define catena_flow_block_pattern_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Which nodes a BlockMatrix couples: a row for each node of this rank, with
   * its columns in ascending order of their local numbers.
   */
  class BlockPattern
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /// No row of this rank.
    static constexpr unsigned int absent =
      dealii::numbers::invalid_unsigned_int;

    /**
     * @param rows, columns the nodes that this rank owns, without a gap
     * @param couplings the pairs of nodes, at least those of @p rows
     */
    BlockPattern(const dealii::IndexSet               &rows,
                 const dealii::IndexSet               &columns,
                 const dealii::DynamicSparsityPattern &couplings,
                 const MPI_Comm                        communicator);

    unsigned int
    n_rows() const
    {
      return row_starts.size() - 1;
    }

    unsigned int
    n_blocks() const
    {
      return columns.size();
    }

    /// Number of the first block of a row; the last is the one before that of
    /// the next row.
    unsigned int
    row_start(const unsigned int row) const
    {
      return row_starts[row];
    }

    /// By block, its column as a local number.
    const unsigned int *
    local_columns() const
    {
      return columns.data();
    }

    /// The nodes that are the columns; those of other ranks are ghosts.
    const Partitioner &
    column_nodes() const
    {
      return *nodes;
    }

    /// The row of a node of this rank; absent for those of others.
    unsigned int
    row(const unsigned int node) const
    {
      return node - first_row < n_rows() ? node - first_row : absent;
    }

    /// Which block of a row is that of the column @p node.
    unsigned int
    offset(const unsigned int row, const unsigned int node) const;

  private:
    unsigned int                       first_row;
    std::vector<unsigned int>          row_starts, columns;
    std::shared_ptr<const Partitioner> nodes;
  };
} // namespace Catena

#endif

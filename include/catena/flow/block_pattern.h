#ifndef catena_flow_block_pattern_h
#define catena_flow_block_pattern_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Nodes of some cells, as many of each.
   */
  struct CellNodes
  {
    /// In place of a node.
    static constexpr unsigned int absent =
      dealii::numbers::invalid_unsigned_int;

    unsigned int              n_nodes;
    std::vector<unsigned int> nodes = {};

    unsigned int
    n_cells() const
    {
      return nodes.size() / n_nodes;
    }

    /// Call @p action with each node of cell @p c that is not absent.
    template <typename Action>
    void
    for_each(const unsigned int c, const Action &action) const
    {
      for (unsigned int i = c * n_nodes; i < (c + 1) * n_nodes; ++i)
        if (nodes[i] != absent)
          action(nodes[i]);
    }
  };



  /**
   * Which nodes a BlockMatrix couples: a row for each node of this rank, with
   * its columns in ascending order of their local numbers.
   */
  class BlockPattern
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /// No row of this rank.
    static constexpr unsigned int absent = CellNodes::absent;

    /**
     * Couple the nodes of the same cell.
     * @param rows, columns the nodes that this rank owns, without a gap
     * @param cell_rows, cell_columns of the same cells, at least those with a
     * node in @p rows
     */
    BlockPattern(const dealii::IndexSet &rows,
                 const dealii::IndexSet &columns,
                 const CellNodes        &cell_rows,
                 const CellNodes        &cell_columns,
                 const MPI_Comm          communicator);

    unsigned int
    n_rows() const
    {
      return starts.size() - 1;
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
      return starts[row];
    }

    /// row_start() of all rows, and the number of blocks.
    const std::vector<unsigned int> &
    row_starts() const
    {
      return starts;
    }

    /// By block, its column as a local number.
    const unsigned int *
    local_columns() const
    {
      return columns.data();
    }

    /// The nodes that are the columns; those of other ranks are ghosts.
    const std::shared_ptr<const Partitioner> &
    column_nodes() const
    {
      return nodes;
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
    std::vector<unsigned int>          starts, columns;
    std::shared_ptr<const Partitioner> nodes;
  };
} // namespace Catena

#endif

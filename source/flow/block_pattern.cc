#include <catena/flow/block_pattern.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace Catena
{
  using namespace dealii;

  BlockPattern::BlockPattern(const IndexSet  &rows,
                             const IndexSet  &columns_owned,
                             const CellNodes &cell_rows,
                             const CellNodes &cell_columns,
                             const MPI_Comm   communicator)
    : first_row(rows.n_elements() > 0 ? rows.nth_index_in_set(0) : 0)
    , starts(rows.n_elements() + 1, 0)
  {
    AssertDimension(cell_rows.n_cells(), cell_columns.n_cells());
    // the cells of each row, and columns that other ranks own
    const unsigned int                   n_cells = cell_rows.n_cells();
    std::vector<unsigned int>            n_cells_before(n_rows() + 1, 0);
    std::vector<types::global_dof_index> of_other_ranks;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        bool has_row = false;
        cell_rows.for_each(c, [&](const unsigned int node) {
          if (row(node) == absent)
            return;
          has_row = true;
          ++n_cells_before[row(node) + 1];
        });
        if (has_row)
          cell_columns.for_each(c, [&](const unsigned int node) {
            if (!columns_owned.is_element(node))
              of_other_ranks.push_back(node);
          });
      }
    std::partial_sum(n_cells_before.begin(),
                     n_cells_before.end(),
                     n_cells_before.begin());
    std::vector<unsigned int> cells(n_cells_before.back()),
      next(n_cells_before);
    for (unsigned int c = 0; c < n_cells; ++c)
      cell_rows.for_each(c, [&](const unsigned int node) {
        if (row(node) != absent)
          cells[next[row(node)]++] = c;
      });

    std::sort(of_other_ranks.begin(), of_other_ranks.end());
    of_other_ranks.erase(std::unique(of_other_ranks.begin(),
                                     of_other_ranks.end()),
                         of_other_ranks.end());
    IndexSet ghosts(columns_owned.size());
    ghosts.add_indices(of_other_ranks.begin(), of_other_ranks.end());
    nodes = std::make_shared<Partitioner>(columns_owned, ghosts, communicator);

    std::vector<unsigned int> last_row(nodes->locally_owned_size() +
                                         nodes->n_ghost_indices(),
                                       absent);
    for (unsigned int r = 0; r < n_rows(); ++r)
      {
        for (unsigned int k = n_cells_before[r]; k < n_cells_before[r + 1]; ++k)
          cell_columns.for_each(cells[k], [&](const unsigned int node) {
            const unsigned int column = nodes->global_to_local(node);
            if (std::exchange(last_row[column], r) != r)
              columns.push_back(column);
          });
        std::sort(columns.begin() + starts[r], columns.end());
        starts[r + 1] = columns.size();
      }
    columns.shrink_to_fit();
  }



  unsigned int
  BlockPattern::offset(const unsigned int row, const unsigned int node) const
  {
    const auto begin = columns.begin() + starts[row],
               end   = columns.begin() + starts[row + 1];
    const auto place =
      std::lower_bound(begin, end, nodes->global_to_local(node));
    Assert(place != end && *place == nodes->global_to_local(node),
           ExcInternalError());
    return place - begin;
  }
} // namespace Catena

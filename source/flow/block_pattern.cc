#include <catena/flow/block_pattern.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  BlockPattern::BlockPattern(const IndexSet               &rows,
                             const IndexSet               &columns_owned,
                             const DynamicSparsityPattern &couplings,
                             const MPI_Comm                communicator)
    : first_row(rows.n_elements() > 0 ? rows.nth_index_in_set(0) : 0)
    , row_starts(1, 0)
  {
    IndexSet ghosts(columns_owned.size());
    for (const auto row : rows)
      for (auto it = couplings.begin(row); it != couplings.end(row); ++it)
        if (!columns_owned.is_element(it->column()))
          ghosts.add_index(it->column());
    nodes = std::make_shared<Partitioner>(columns_owned, ghosts, communicator);

    for (const auto row : rows)
      {
        for (auto it = couplings.begin(row); it != couplings.end(row); ++it)
          columns.push_back(nodes->global_to_local(it->column()));
        std::sort(columns.begin() + row_starts.back(), columns.end());
        row_starts.push_back(columns.size());
      }
  }



  unsigned int
  BlockPattern::offset(const unsigned int row, const unsigned int node) const
  {
    const auto begin = columns.begin() + row_starts[row],
               end   = columns.begin() + row_starts[row + 1];
    const auto place =
      std::lower_bound(begin, end, nodes->global_to_local(node));
    Assert(place != end && *place == nodes->global_to_local(node),
           ExcInternalError());
    return place - begin;
  }
} // namespace Catena

#include <catena/flow/lane_entries.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace Catena
{
  LaneEntries::LaneEntries(const NodeMatrix               &shared,
                           const std::vector<FieldMatrix> &others,
                           const std::vector<FieldMask>   &masks)
  {
    const std::vector<unsigned int> node_fields =
      with_ghosts({masks.begin(), masks.end()}, shared.column_nodes());
    for (unsigned int i = 0; i < shared.n_rows(); ++i)
      {
        const auto range = shared.row(i);
        for (unsigned int k = range.first; k < range.second; ++k)
          {
            const unsigned int fields =
              node_fields[i] & node_fields[shared.column(k)];
            std::array<float, n_lanes> differences = {};
            for (const FieldMatrix &other : others)
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                if (((other.fields & fields) >> lane) & 1U)
                  differences[lane] = other.matrix.value(k) - shared.value(k);
            if (std::any_of(differences.begin(),
                            differences.end(),
                            [](const float x) { return x != 0.f; }))
              {
                columns.push_back(shared.column(k));
                values.insert(values.end(),
                              differences.begin(),
                              differences.end());
              }
          }
        if (columns.size() > starts.back())
          {
            rows.push_back(i);
            starts.push_back(columns.size());
          }
      }
  }



  Lanes
  LaneEntries::value(const unsigned int entry) const
  {
    Lanes result;
    std::memcpy(&result, &values[n_lanes * entry], sizeof(Lanes));
    return result;
  }



  void
  LaneEntries::add_product(Lanes       *dst,
                           const float  factor,
                           const Lanes *src) const
  {
    for (unsigned int r = 0; r < rows.size(); ++r)
      for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
        dst[rows[r]] += factor * value(k) * src[columns[k]];
  }



  void
  LaneEntries::add_diagonal(Lanes *diagonal) const
  {
    for (unsigned int r = 0; r < rows.size(); ++r)
      for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
        if (columns[k] == rows[r])
          diagonal[rows[r]] += value(k);
  }
} // namespace Catena

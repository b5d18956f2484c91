#include <catena/flow/lane_entries.h>

#include <cmath>

namespace Catena
{
  LaneEntries::LaneEntries(const std::vector<FieldMatrix> &matrices,
                           const std::vector<FieldMask>   &masks)
  {
    if (matrices.size() == 1)
      return;
    const NodeRows                 &shared = matrices.front().rows;
    const std::vector<unsigned int> node_fields =
      with_ghosts({masks.begin(), masks.end()}, shared.column_nodes());
    for (unsigned int i = 0; i < shared.n_rows(); ++i)
      {
        const auto range = shared.row(i);
        for (unsigned int k = range.first; k < range.second; ++k)
          {
            const unsigned int fields =
              node_fields[i] & node_fields[shared.column(k)];
            Lanes differences = {};
            for (const FieldMatrix &matrix : matrices)
              {
                AssertDimension(matrix.rows.column(k), shared.column(k));
                for (unsigned int lane = 0; lane < n_lanes; ++lane)
                  if (((matrix.fields & fields) >> lane) & 1U)
                    differences[lane] = matrix.rows.value(k) - shared.value(k);
              }
            bool differs = false;
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              differs = differs || differences[lane] != 0.f;
            if (differs)
              add(shared.column(k), differences);
          }
        end_row(i);
      }
  }



  void
  LaneEntries::add(const unsigned int column, const Lanes entry)
  {
    columns.push_back(column);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      values.push_back(entry[lane]);
  }



  void
  LaneEntries::end_row(const unsigned int i)
  {
    if (columns.size() > starts.back())
      {
        rows.push_back(i);
        starts.push_back(columns.size());
      }
  }



  void
  LaneEntries::add_product(Lanes       *dst,
                           const float  factor,
                           const Lanes *src) const
  {
    for (unsigned int r = 0; r < rows.size(); ++r)
      dst[rows[r]] += factor * row_times(r, src);
  }



  void
  LaneEntries::add_sums_of_moduli(Lanes *dst) const
  {
    for (unsigned int r = 0; r < rows.size(); ++r)
      for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          dst[rows[r]][lane] += std::abs(value(k)[lane]);
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

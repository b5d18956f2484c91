#ifndef catena_flow_lane_entries_h
#define catena_flow_lane_entries_h

#include <catena/flow/node_matrix.h>

#include <cstring>
#include <vector>

namespace Catena
{
  /**
   * What the matrices of single fields have more, or less, than the NodeMatrix
   * that all fields share: on few entries, where the signs of their identified
   * nodes differ. Rows and columns in which a field has no unknown are left as
   * they are shared.
   */
  class LaneEntries
  {
  public:
    LaneEntries() = default;

    /**
     * @param matrices of the fields, with entries in the same places; the first
     * one is the shared matrix
     * @param masks which fields have an unknown, by node of this rank
     */
    LaneEntries(const std::vector<FieldMatrix> &matrices,
                const std::vector<FieldMask>   &masks);

    /// The entries whose @p predicate, of row and column, is true.
    template <typename Predicate>
    LaneEntries
    select(const Predicate &predicate) const
    {
      LaneEntries selected;
      for (unsigned int r = 0; r < n_rows(); ++r)
        {
          for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
            if (predicate(rows[r], columns[k]))
              selected.add(columns[k], value(k));
          selected.end_row(rows[r]);
        }
      return selected;
    }

    /// Of rows that have entries.
    unsigned int
    n_rows() const
    {
      return rows.size();
    }

    /// The number of the row of the matrix that is row @p r here. They ascend.
    unsigned int
    row(const unsigned int r) const
    {
      return rows[r];
    }

    /// E src, in row @p r.
    Lanes
    row_times(const unsigned int r, const Lanes *src) const
    {
      Lanes sum = {};
      for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
        sum += value(k) * src[columns[k]];
      return sum;
    }

    /// dst += E^T src, of row @p r alone.
    void
    add_transposed_row(const unsigned int r, const Lanes src, Lanes *dst) const
    {
      for (unsigned int k = starts[r]; k < starts[r + 1]; ++k)
        dst[columns[k]] += value(k) * src;
    }

    /// dst += factor E src
    void
    add_product(Lanes *dst, const float factor, const Lanes *src) const;

    /// Add the sums of |e_ij| over the columns j.
    void
    add_sums_of_moduli(Lanes *dst) const;

    /// Add the entries on the diagonal.
    void
    add_diagonal(Lanes *diagonal) const;

  private:
    /// rows that have entries, their ranges of entries, and columns
    std::vector<unsigned int> rows, starts = {0}, columns;
    /// n_lanes for each entry
    std::vector<float> values;

    Lanes
    value(const unsigned int entry) const
    {
      Lanes result;
      std::memcpy(&result, &values[n_lanes * entry], sizeof(Lanes));
      return result;
    }

    void
    add(const unsigned int column, const Lanes entry);

    /// Of row @p i, if entries were added to it.
    void
    end_row(const unsigned int i);
  };
} // namespace Catena

#endif

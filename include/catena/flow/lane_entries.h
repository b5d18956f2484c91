#ifndef catena_flow_lane_entries_h
#define catena_flow_lane_entries_h

#include <catena/flow/node_matrix.h>

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
    /// The matrix of some of the fields.
    struct FieldMatrix
    {
      FieldMask  fields;
      NodeMatrix matrix;
    };

    LaneEntries() = default;

    /**
     * @param shared the shared matrix
     * @param others those of other fields, with the same columns
     * @param masks which fields have an unknown, by node of this rank
     */
    LaneEntries(const NodeMatrix               &shared,
                const std::vector<FieldMatrix> &others,
                const std::vector<FieldMask>   &masks);

    /// dst += factor E src
    void
    add_product(Lanes *dst, const float factor, const Lanes *src) const;

    /// Add the entries on the diagonal.
    void
    add_diagonal(Lanes *diagonal) const;

  private:
    /// rows that have entries, their ranges of entries, and columns
    std::vector<unsigned int> rows, starts = {0}, columns;
    /// n_lanes for each entry
    std::vector<float> values;

    Lanes
    value(const unsigned int entry) const;
  };
} // namespace Catena

#endif

#ifndef catena_flow_smoothed_aggregation_h
#define catena_flow_smoothed_aggregation_h

#include <catena/flow/node_matrix.h>

namespace Catena
{
  /**
   * A coarser level made of aggregates, a few neighbouring nodes each (Vanek,
   * Mandel and Brezina, Computing 56, 1996): fields that are constant on each
   * aggregate, P_0, smoothed by a step of Jacobi's method,
   *
   *   P = (1 - omega D^-1 A) P_0,   omega = 4 / (3 lambda_max(D^-1 A)).
   *
   * Nodes are gathered along negative couplings
   *
   *   a_ij < 0,   a_ij^2 > theta^2 a_ii a_jj
   *
   * only. Across an identified plane where a field comes back with the
   * opposite sign, a coupling has the opposite sign too: no aggregate lies on
   * both sides of it, a constant is right on each of them, and the smoothing
   * continues it beyond the plane with its sign.
   *
   * Nodes where some of the fields have no unknown are aggregated among
   * themselves and not smoothed. So what is interpolated to them comes from
   * such aggregates alone, and with these left out P^T A P is also the operator
   * of the fields that have no unknown there: one matrix serves all. Nodes
   * without any are in no aggregate.
   *
   * Aggregates belong to one rank.
   */
  class SmoothedAggregation
  {
  public:
    /**
     * @param matrix operator A of a level
     * @param masks of this rank's nodes, without fields that have another
     * operator
     */
    SmoothedAggregation(const NodeRows               &matrix,
                        const std::vector<FieldMask> &masks);

    /// The rows of P of this rank's nodes.
    SparseRows prolongation;
    /// of this rank's aggregates
    std::vector<FieldMask> masks;

  private:
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /// Aggregate of each of this rank's nodes, or none.
    std::vector<unsigned int>
    aggregate(const NodeRows               &matrix,
              const std::vector<float>     &diagonal,
              const std::vector<FieldMask> &node_masks);
  };
} // namespace Catena

#endif

#ifndef catena_flow_multigrid_level_h
#define catena_flow_multigrid_level_h

#include <catena/flow/lane_entries.h>
#include <catena/flow/node_matrix.h>
#include <catena/flow/smoothed_aggregation.h>

#include <vector>

namespace Catena
{
  /**
   * A level of VelocityMultigrid: the operator A, and a smoother, two steps of
   * Chebyshev's iteration preconditioned by the diagonal D,
   *
   *   d_1 = D^-1 r / t,   d_2 = c_1 d_1 + c_2 D^-1 r,   x += d_1 + d_2,
   *
   * with coefficients for the eigenvalues of D^-1 A between
   * lambda_max / smoothing_range and 1.2 lambda_max. Besides a step d only the
   * residual is kept up to date, so that each step is one sweep over A.
   */
  class MultigridLevel
  {
  public:
    /**
     * @param masks which fields have an unknown, by node of this rank
     * @param extra what A has more than @p matrix for some of the fields
     */
    MultigridLevel(NodeMatrix                    matrix,
                   const std::vector<FieldMask> &masks,
                   const double                  smoothing_range,
                   LaneEntries                   extra = {});

    const NodeMatrix &
    matrix() const
    {
      return level_matrix;
    }

    double
    largest_eigenvalue() const
    {
      return eigenvalue;
    }

    /// x from zero for the right-hand side in the residual, which becomes that
    /// of x.
    void
    smooth_from_zero() const;

    /// Smooth x after the step is added to it.
    void
    smooth_after_step() const;

    /// x, b - A x, and a correction of x.
    mutable NodeVector solution, residual, step;

  private:
    NodeMatrix         level_matrix;
    LaneEntries        extra_entries;
    NodeVector         inverse_diagonal;
    mutable NodeVector next_step;
    double             eigenvalue = 0.;

    /// 1 / t, c_1, c_2
    float first_weight, step_weight, residual_weight;

    void
    estimate_eigenvalue();

    /// residual -= A step; then what is to be done at a node with its residual
    template <typename Function>
    void
    take_step(const Function &at_node) const;

    void
    second_step() const;
  };
} // namespace Catena

#endif

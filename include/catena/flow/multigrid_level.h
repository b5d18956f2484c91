#ifndef catena_flow_multigrid_level_h
#define catena_flow_multigrid_level_h

#include <catena/flow/lane_entries.h>
#include <catena/flow/node_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * A level of VelocityMultigrid: the operator A = L + D + L^T, symmetric, with
   * L below the diagonal, and a smoother, a sweep of Gauss and Seidel before
   * the correction of the coarser levels and one in the opposite order after
   * it,
   *
   *   (D + L) x = b                          from x = 0,
   *   (D + L^T) (x_new - x) = b - A x.
   *
   * Only L is kept, and a sweep reads it once: by its rows it gathers what
   * unknowns take from those before them, and by its columns, the rows of L^T,
   * it adds to the residuals of those before.
   *
   * Unknowns of other ranks are what they were before the sweep. In D their
   * couplings are added without their signs: so the smoother converges on any
   * number of ranks (Baker, Falgout, Kolev and Yang, SIAM J. Sci. Comput. 33,
   * 2011, 2864-2887).
   */
  class MultigridLevel
  {
  public:
    /**
     * @param matrix A, of which a copy of what is needed is kept
     * @param masks which fields have an unknown, by node of this rank
     * @param extra what A has more than @p matrix for some of the fields
     */
    MultigridLevel(const NodeMatrix             &matrix,
                   const std::vector<FieldMask> &masks,
                   const LaneEntries            &extra = {});

    unsigned int
    n_nodes() const
    {
      return lower.n_rows();
    }

    /// x from zero for the right-hand side b in the residual, which becomes
    /// that of x.
    void
    smooth_from_zero() const;

    /// Smooth x, which is that of smooth_from_zero() with a correction.
    void
    smooth_corrected() const;

    /// x and b - A x.
    mutable NodeVector solution, residual;

  private:
    NodeMatrix         lower, of_other_ranks;
    LaneEntries        extra_lower, extra_of_other_ranks;
    NodeVector         inverse_diagonal;
    mutable NodeVector right_hand_side;

    /// residual -= (A - D - L - L^T) x: what a sweep does not solve for, the
    /// part of x that other ranks have and what D has in place of it.
    void
    subtract_other_ranks() const;

    /// Solve equation i for x_i, with the residual of what comes later, and
    /// take it from the residuals of what comes before.
    /// @param extra row of extra_lower, if it is that of i
    void
    relax(const unsigned int i, const unsigned int extra) const;
  };
} // namespace Catena

#endif

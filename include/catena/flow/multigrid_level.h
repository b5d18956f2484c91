#ifndef catena_flow_multigrid_level_h
#define catena_flow_multigrid_level_h

#include <catena/flow/lane_entries.h>
#include <catena/flow/node_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * A level of VelocityMultigrid: the operator A, symmetric, with the part L
   * below its diagonal D, and a smoother, a sweep of Gauss and Seidel before
   * the correction of the coarser levels and one in the opposite order after
   * it,
   *
   *   (D + L) x = b                          from x = 0,
   *   (D + L^T) (x_new - x) = b - A x.
   *
   * Only L is kept, and a sweep reads it once: from row i it gathers what x_i
   * takes from the unknowns before it, and as that row is column i of L^T, it
   * subtracts what x_i does from the residuals of those before.
   *
   * On one rank A = L + D + L^T. On more, L has the nodes of a rank alone;
   * unknowns of other ranks are what they were before the sweep, and D has
   * their couplings, too, without their signs: so the smoother converges on any
   * number of ranks (Baker, Falgout, Kolev and Yang, SIAM J. Sci. Comput. 33,
   * 2011, 2864-2887).
   */
  class MultigridLevel
  {
  public:
    /**
     * @param matrices A of the fields, with entries in the same places, of
     * which a copy of what is needed is kept
     * @param masks which fields have an unknown, by node of this rank
     */
    MultigridLevel(const std::vector<FieldMatrix> &matrices,
                   const std::vector<FieldMask>   &masks);

    unsigned int
    n_nodes() const
    {
      return lower.n_rows();
    }

    /// x from zero for the right-hand side b in the residual, which becomes
    /// that of x.
    void
    smooth_from_zero() const;

    /// Smooth x, that of the last smooth_from_zero() with a correction, for the
    /// same b. The residual is used up.
    void
    smooth_corrected() const;

    /// x and, after smooth_from_zero(), b - A x.
    mutable NodeVector solution, residual;

  private:
    NodeMatrix  lower, of_other_ranks;
    LaneEntries extra_lower, extra_of_other_ranks;
    /// what D has for other ranks, and D^-1
    NodeVector         added_diagonal, inverse_diagonal;
    mutable NodeVector right_hand_side;

    /// residual -= (A - D - L - L^T) x: what a sweep does not solve for, the
    /// part of x that other ranks have and what D has in place of it.
    void
    subtract_other_ranks() const;

    /// Is row number @p extra_row of extra_lower that of i?
    bool
    has_extra(const unsigned int i, const unsigned int extra_row) const
    {
      return extra_row < extra_lower.n_rows() &&
             extra_lower.row(extra_row) == i;
    }

    /// Solve equation i for x_i, with the residual of what comes later, and
    /// subtract what x_i does from the residuals of what comes before.
    void
    relax(const unsigned int i, const unsigned int extra_row) const;
  };
} // namespace Catena

#endif

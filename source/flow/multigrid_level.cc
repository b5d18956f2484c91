#include <catena/flow/multigrid_level.h>

namespace Catena
{
  MultigridLevel::MultigridLevel(const NodeMatrix             &matrix,
                                 const std::vector<FieldMask> &masks,
                                 const LaneEntries            &extra)
  {
    const unsigned int n        = matrix.n_rows();
    const auto         is_lower = [](const unsigned int row,
                             const unsigned int column) {
      return column < row;
    };
    const auto is_of_other_rank = [n](const unsigned int,
                                      const unsigned int column) {
      return column >= n;
    };
    lower                = matrix.select(is_lower);
    of_other_ranks       = matrix.select(is_of_other_rank);
    extra_lower          = extra.select(is_lower);
    extra_of_other_ranks = extra.select(is_of_other_rank);

    for (NodeVector *vector :
         {&solution, &residual, &right_hand_side, &inverse_diagonal})
      reinit(*vector, matrix.column_nodes());
    Lanes *const D = lanes(inverse_diagonal);
    for (unsigned int i = 0; i < n; ++i)
      D[i] = Lanes{} + (matrix.diagonal(i) + of_other_ranks.sum_of_moduli(i));
    extra.add_diagonal(D);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        D[i][lane] = ((masks[i] >> lane) & 1U) ? 1.f / D[i][lane] : 0.f;
  }



  void
  MultigridLevel::subtract_other_ranks() const
  {
    if (of_other_ranks.column_nodes().n_mpi_processes() == 1)
      return;
    solution.update_ghost_values();
    const Lanes *const x = lanes(solution);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      lanes(residual)[i] +=
        of_other_ranks.sum_of_moduli(i) * x[i] - of_other_ranks.row_times(i, x);
    extra_of_other_ranks.add_product(lanes(residual), -1.f, x);
  }



  inline void
  MultigridLevel::relax(const unsigned int i, const unsigned int extra) const
  {
    Lanes *const x = lanes(solution), *const r = lanes(residual);
    const bool has_extra =
      extra < extra_lower.n_rows() && extra_lower.row(extra) == i;
    Lanes rest = r[i] - lower.row_times(i, x);
    if (has_extra)
      rest -= extra_lower.row_times(extra, x);
    x[i] = lanes(inverse_diagonal)[i] * rest;
    lower.add_transposed_row(i, -x[i], r);
    if (has_extra)
      extra_lower.add_transposed_row(extra, -x[i], r);
  }



  void
  MultigridLevel::smooth_from_zero() const
  {
    Lanes *const r = lanes(residual), *const b = lanes(right_hand_side);
    unsigned int extra = 0;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        b[i] = r[i];
        relax(i, extra);
        r[i] = Lanes{};
        if (extra < extra_lower.n_rows() && extra_lower.row(extra) == i)
          ++extra;
      }
    subtract_other_ranks();
  }



  void
  MultigridLevel::smooth_corrected() const
  {
    Lanes *const       r = lanes(residual);
    const Lanes *const b = lanes(right_hand_side);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      r[i] = b[i];
    subtract_other_ranks();
    unsigned int extra = extra_lower.n_rows();
    for (unsigned int i = n_nodes(); i-- > 0;)
      {
        if (extra > 0 && extra_lower.row(extra - 1) == i)
          --extra;
        relax(i, extra);
      }
  }
} // namespace Catena

#include <catena/flow/multigrid_level.h>

namespace Catena
{
  MultigridLevel::MultigridLevel(const std::vector<FieldMatrix> &matrices,
                                 const std::vector<FieldMask>   &masks)
  {
    const NodeRows    &matrix = matrices.front().rows;
    const LaneEntries  extra(matrices, masks);
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

    for (NodeVector *vector : {&solution,
                               &residual,
                               &right_hand_side,
                               &added_diagonal,
                               &inverse_diagonal})
      reinit(*vector, matrix.column_nodes());
    Lanes *const added = lanes(added_diagonal);
    for (unsigned int i = 0; i < n; ++i)
      added[i] = Lanes{} + of_other_ranks.sum_of_moduli(i);
    extra_of_other_ranks.add_sums_of_moduli(added);

    Lanes *const D = lanes(inverse_diagonal);
    for (unsigned int i = 0; i < n; ++i)
      D[i] = matrix.diagonal(i) + added[i];
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
    const Lanes *const x = lanes(solution), *const added =
                                              lanes(added_diagonal);
    Lanes *const r = lanes(residual);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      r[i] += added[i] * x[i] - of_other_ranks.row_times(i, x);
    extra_of_other_ranks.add_product(r, -1.f, x);
  }



  inline void
  MultigridLevel::relax(const unsigned int i,
                        const unsigned int extra_row) const
  {
    Lanes *const x = lanes(solution), *const r = lanes(residual);
    const bool has_more = has_extra(i, extra_row);
    Lanes      rest     = r[i] - lower.row_times(i, x);
    if (has_more)
      rest -= extra_lower.row_times(extra_row, x);
    x[i] = lanes(inverse_diagonal)[i] * rest;
    lower.add_transposed_row(i, -x[i], r);
    if (has_more)
      extra_lower.add_transposed_row(extra_row, -x[i], r);
  }



  void
  MultigridLevel::smooth_from_zero() const
  {
    Lanes *const r = lanes(residual), *const b = lanes(right_hand_side);
    unsigned int extra_row = 0;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        b[i] = r[i];
        relax(i, extra_row);
        r[i] = Lanes{};
        if (has_extra(i, extra_row))
          ++extra_row;
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
    unsigned int extra_row = extra_lower.n_rows();
    for (unsigned int i = n_nodes(); i-- > 0;)
      {
        if (extra_row > 0 && has_extra(i, extra_row - 1))
          --extra_row;
        relax(i, extra_row);
      }
  }
} // namespace Catena

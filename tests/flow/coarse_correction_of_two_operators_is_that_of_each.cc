// A coarse correction for fields with operators of their own, which share a
// level, against those of one operator after the other.

#include <catena/flow/coarse_correction.h>

#include <cmath>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

namespace
{
  // more than what is inverted at once
  constexpr unsigned int n_coarse = 400, n_fine = 2 * n_coarse;

  constexpr FieldMask fields = 0b0111, other_field = 0b1000;

  /// Nodes on a ring, with bonds to the next and the one after the next, of
  /// which those that cross a plane have the sign @p across.
  SparseRows
  ring(const float across)
  {
    SparseRows rows;
    for (unsigned int i = 0; i < n_fine; ++i)
      {
        for (const int step : {-2, -1, 0, 1, 2})
          {
            const unsigned int j    = (i + n_fine + step) % n_fine;
            const float        sign = (i < 300) != (j < 300) ? across : 1.f;
            rows.add(j,
                     step == 0           ? 2.6f :
                     std::abs(step) == 1 ? -sign :
                                           -0.25f * sign);
          }
        rows.end_row();
      }
    return rows;
  }

  /// The coarse node of a pair, with a share of the one after it.
  SparseRows
  pairs()
  {
    SparseRows rows;
    for (unsigned int i = 0; i < n_fine; ++i)
      {
        rows.add(i / 2, 1.f - i % 2 / 2.f);
        if (i % 2 == 1)
          rows.add((i / 2 + 1) % n_coarse, 0.5f);
        rows.end_row();
      }
    return rows;
  }

  /// One of the fields has no unknown at some nodes.
  std::vector<FieldMask>
  masks(const FieldMask of)
  {
    std::vector<FieldMask> result;
    for (unsigned int i = 0; i < n_coarse; ++i)
      result.push_back(of & (i % 50 == 7 ? 0b1110 : 0b1111));
    return result;
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    SparseRows       rows = ring(1.f), other_rows = ring(-1.f);
    const SparseRows prolongation = pairs();
    const auto       nodes        = make_nodes(n_fine, {&rows}, MPI_COMM_WORLD);
    rows.make_local(*nodes);
    other_rows.make_local(*nodes);
    const CoarseCorrection::FieldOperator shared{{fields, {rows, nodes}},
                                                 &prolongation},
      other{{other_field, {other_rows, nodes}}, &prolongation};
    const CoarseCorrection both({shared, other},
                                masks(fields | other_field),
                                MPI_COMM_WORLD),
      first({shared}, masks(fields), MPI_COMM_WORLD),
      last({other}, masks(other_field), MPI_COMM_WORLD);

    NodeVector residual, of_both, of_each;
    for (NodeVector *vector : {&residual, &of_both, &of_each})
      reinit(*vector, *nodes);
    for (const auto i : residual.locally_owned_elements())
      residual(i) = (5 * (i / n_lanes) + 3 * (i % n_lanes)) % 16 / 8.f - 1.f;
    both.correct(of_both, residual);
    first.correct(of_each, residual);
    last.correct(of_each, residual);

    claims.holds("there is a correction", of_both.linfty_norm() > 0.1);
    of_each -= of_both;
    claims.at_most("both give the same", of_each.linfty_norm(), 1e-6);
  });
}

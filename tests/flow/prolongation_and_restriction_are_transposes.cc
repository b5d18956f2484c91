// Interpolation from a coarser level and its transpose against sums over all
// entries of the matrix, where some rows differ between the fields.

#include <catena/flow/prolongation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

namespace
{
  constexpr unsigned int coarse_of_rank = 5, fine_of_rank = 13;

  /// An entry that single precision has, in few columns of a row, of any rank.
  float
  entry(const unsigned int row, const unsigned int column)
  {
    const unsigned int d = (3 * row + 2 * column) % 7;
    return d < 2 ? 0.5f - d : 0.f;
  }

  /// Sums of products with them have no rounding.
  float
  value(const unsigned int node, const unsigned int lane)
  {
    return (5 * node + 3 * lane) % 16 / 8.f - 1.f;
  }

  /// Set the values of the nodes of this rank, zero elsewhere.
  void
  set_values(NodeVector &vector)
  {
    vector = 0.f;
    for (const auto i : vector.locally_owned_elements())
      vector(i) = value(i / n_lanes, i % n_lanes);
  }

  /// Largest difference to @p sum, of node and lane.
  template <typename Sum>
  double
  difference(const NodeVector &vector, const Sum &sum)
  {
    double largest = 0.;
    for (const auto i : vector.locally_owned_elements())
      largest =
        std::max(largest,
                 std::abs(double(vector(i)) - sum(i / n_lanes, i % n_lanes)));
    return Utilities::MPI::max(largest, vector.get_mpi_communicator());
  }
} // namespace

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const MPI_Comm     comm     = MPI_COMM_WORLD;
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(comm),
                       rank     = Utilities::MPI::this_mpi_process(comm),
                       n_coarse = n_ranks * coarse_of_rank,
                       n_fine   = n_ranks * fine_of_rank;

    // a row without entries, too; the last field has some of other signs
    constexpr unsigned int last_lane = n_lanes - 1;
    const auto             P         = [&](const unsigned int row,
                       const unsigned int column,
                       const unsigned int lane) {
      const float sign = lane == last_lane && row % 5 == 1 ? -1.f : 1.f;
      return row % 4 != 0 ? sign * entry(row, column) : 0.f;
    };
    const auto rows_of = [&](const unsigned int lane) {
      SparseRows rows;
      for (unsigned int i = 0; i < fine_of_rank; ++i)
        {
          const unsigned int row = fine_of_rank * rank + i;
          for (unsigned int column = 0; column < n_coarse; ++column)
            if (P(row, column, lane) != 0.f)
              rows.add(column, P(row, column, lane));
          rows.end_row();
        }
      return rows;
    };
    const SparseRows rows = rows_of(0), last_rows = rows_of(last_lane);
    const auto       coarse_nodes = make_nodes(coarse_of_rank, {&rows}, comm),
               fine_nodes         = make_nodes(fine_of_rank, {}, comm);
    const Prolongation prolongation({{0b0111, &rows}, {0b1000, &last_rows}},
                                    *coarse_nodes);

    NodeVector coarse, fine;
    reinit(coarse, *coarse_nodes);
    reinit(fine, *fine_nodes);
    set_values(coarse);
    set_values(fine);
    coarse.update_ghost_values();
    prolongation.add_product(lanes(fine), lanes(coarse));
    claims.near("what is added is the product",
                difference(fine,
                           [&](const unsigned int row,
                               const unsigned int lane) {
                             double sum = value(row, lane);
                             for (unsigned int c = 0; c < n_coarse; ++c)
                               sum += P(row, c, lane) * value(c, lane);
                             return sum;
                           }),
                0.,
                0.);

    coarse.zero_out_ghost_values();
    set_values(coarse);
    set_values(fine);
    prolongation.add_transposed_product(lanes(coarse), lanes(fine));
    coarse.compress(VectorOperation::add);
    claims.near("and that of the transpose",
                difference(coarse,
                           [&](const unsigned int c, const unsigned int lane) {
                             double sum = value(c, lane);
                             for (unsigned int row = 0; row < n_fine; ++row)
                               sum += P(row, c, lane) * value(row, lane);
                             return sum;
                           }),
                0.,
                0.);
  });
}

// Products with matrices of blocks against sums over all pairs of coupled
// nodes.

#include <catena/flow/block_matrix.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

namespace
{
  constexpr unsigned int nodes_of_rank = 9;

  /// Rings of all nodes, with bonds to the next and some to one far away.
  bool
  coupled(const unsigned int i, const unsigned int j, const unsigned int n)
  {
    return (i + n - j) % n <= 1 || (j + n - i) % n <= 1 ||
           (i % 4 == 0 && (j + n - i) % n == 5);
  }

  /// An entry that single precision has, too.
  double
  entry(const unsigned int row, const unsigned int column)
  {
    return ((7 * row + 3 * column) % 11) / 8. - 0.5;
  }

  /// Products and sums of them have no rounding.
  double
  source(const unsigned int dof)
  {
    return ((5 * dof) % 16) / 8. - 1.;
  }

  template <int n_rows>
  double
  product_error(const BlockMatrix<n_rows> &matrix,
                const FastVectorType      &src,
                FastVectorType             dst)
  {
    FastVectorType product(dst), rhs(dst);
    rhs = 1.;
    matrix.vmult(product, src);
    matrix.residual(dst, src, rhs);
    dst -= product;
    const unsigned int n = src.size();
    FastVectorType     difference(dst);
    for (const auto row : dst.locally_owned_elements())
      {
        difference(row) -= 1.;
        for (unsigned int column = 0; column < n; ++column)
          if (coupled(row / n_rows, column, n))
            difference(row) += 2. * entry(row, column) * source(column);
      }
    return difference.linfty_norm();
  }

  template <int n_rows>
  void
  check(Tests::Claims &claims)
  {
    const MPI_Comm     comm    = MPI_COMM_WORLD;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm),
                       rank    = Utilities::MPI::this_mpi_process(comm),
                       n       = n_ranks * nodes_of_rank;
    const auto owned           = [&](const unsigned int n_components) {
      IndexSet set(n_components * n);
      set.add_range(n_components * nodes_of_rank * rank,
                    n_components * nodes_of_rank * (rank + 1));
      return set;
    };

    // a cell of each node with those it is coupled to
    CellNodes rows{1}, columns{n};
    for (unsigned int i = 0; i < n; ++i)
      {
        rows.nodes.push_back(i);
        for (unsigned int j = 0; j < n; ++j)
          columns.nodes.push_back(coupled(i, j, n) ? j : CellNodes::absent);
      }
    const auto pattern = std::make_shared<const BlockPattern>(
      owned(1), owned(1), rows, columns, comm);
    BlockMatrix<n_rows> matrix(pattern);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            const unsigned int row = pattern->row(i);
            if (row != BlockPattern::absent && coupled(i, j, n))
              matrix.block(row, pattern->offset(row, j))[r] +=
                entry(n_rows * i + r, j);
          }

    const std::string shape =
      ", blocks of " + std::to_string(n_rows) + " numbers";
    FastVectorType src(owned(1), comm), dst(owned(n_rows), comm);
    for (const auto i : src.locally_owned_elements())
      src(i) = source(i);
    claims.at_most("products are right" + shape,
                   product_error(matrix, src, dst),
                   1e-13);
    double difference = 0.;
    for (const auto row : dst.locally_owned_elements())
      for (unsigned int column = 0; column < n; ++column)
        if (coupled(row / n_rows, column, n))
          difference =
            std::max(difference,
                     std::abs(matrix.el(row, column) - entry(row, column)));
    claims.near("entries are found" + shape,
                Utilities::MPI::max(difference, comm),
                0.,
                0.);
    matrix.clear();
    matrix.vmult(dst, src);
    claims.near("without entries nothing is left" + shape,
                dst.linfty_norm(),
                0.,
                0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check<1>(claims);
    check<2>(claims);
    check<3>(claims);
  });
}

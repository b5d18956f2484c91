// Two meshes of which each rank owns as many nodes, but sees others of its
// neighbour's: a field of the one in place of one of the other brings the
// values of its own ghosts along.

#include <catena/base/replace_field.h>

#include <deal.II/base/mpi.h>

#include "../tests.h"

using namespace Catena;
using namespace Catena::Tests;

constexpr unsigned int n_owned = 4;

/// A field with the value of each index, and one ghost: the neighbour's @p
/// n-th.
VectorType
field(const unsigned int n)
{
  const unsigned int rank =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  dealii::IndexSet owned(2 * n_owned), relevant(2 * n_owned);
  owned.add_range(rank * n_owned, (rank + 1) * n_owned);
  relevant.add_indices(owned);
  relevant.add_index((1 - rank) * n_owned + n);
  VectorType result(owned, relevant, MPI_COMM_WORLD);
  for (const auto i : owned)
    result(i) = i;
  result.update_ghost_values();
  return result;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const unsigned int neighbour =
      1 - dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    VectorType       present = field(0);
    const VectorType other   = field(2);
    replace_field(present, other);
    const unsigned int ghost = neighbour * n_owned + 2;
    const bool         known =
      present.get_partitioner()->ghost_indices().is_element(ghost);
    claims.holds("the ghost is known on each rank",
                 dealii::Utilities::MPI::min(known ? 1 : 0, MPI_COMM_WORLD) ==
                   1);
    const double difference =
      known ? std::abs(present(ghost) - ghost) : double(ghost);
    claims.at_most("it has its value",
                   dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD),
                   0.);
  });
}

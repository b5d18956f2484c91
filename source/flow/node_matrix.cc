#include <catena/base/node_dofs.h>
#include <catena/flow/node_matrix.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  void
  NodeMatrix::reserve(const std::vector<unsigned int> &row_sizes)
  {
    unsigned int n_entries = 0;
    for (const unsigned int n : row_sizes)
      n_entries += (n + stride - 1) / stride * stride;
    rows.starts.reserve(row_sizes.size() + 1);
    rows.columns.reserve(n_entries);
    rows.values.reserve(n_entries);
  }



  void
  NodeMatrix::end_row()
  {
    while (rows.columns.size() % stride != 0)
      rows.add(rows.columns.back(), 0.f);
    rows.end_row();
  }



  float
  NodeRows::diagonal(const unsigned int i) const
  {
    for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
      if (columns[k] == i)
        return values[k];
    return 0.f;
  }



  std::vector<unsigned int>
  first_of_ranks(const unsigned int n_owned, const MPI_Comm communicator)
  {
    std::vector<unsigned int> first = {0};
    for (const unsigned int n :
         Utilities::MPI::all_gather(communicator, n_owned))
      first.push_back(first.back() + n);
    return first;
  }



  std::shared_ptr<const Utilities::MPI::Partitioner>
  make_nodes(const unsigned int                     n_owned,
             const std::vector<const SparseRows *> &rows,
             const MPI_Comm                         communicator)
  {
    const auto         firsts = first_of_ranks(n_owned, communicator);
    const unsigned int first =
      firsts[Utilities::MPI::this_mpi_process(communicator)];
    IndexSet owned(firsts.back()), ghosts(firsts.back());
    owned.add_range(first, first + n_owned);

    std::vector<types::global_dof_index> others;
    for (const SparseRows *some : rows)
      for (const unsigned int column : some->columns)
        if (column < first || column >= first + n_owned)
          others.push_back(column);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    ghosts.add_indices(others.begin(), others.end());
    return std::make_shared<Utilities::MPI::Partitioner>(owned,
                                                         ghosts,
                                                         communicator);
  }



  void
  reinit(NodeVector &vector, const Utilities::MPI::Partitioner &nodes)
  {
    vector.reinit(node_dofs(nodes.locally_owned_range(), n_lanes),
                  node_dofs(nodes.ghost_indices(), n_lanes),
                  nodes.get_mpi_communicator());
  }



  std::vector<unsigned int>
  with_ghosts(const std::vector<unsigned int>   &owned,
              const Utilities::MPI::Partitioner &nodes)
  {
    LinearAlgebra::distributed::Vector<double> vector(
      nodes.locally_owned_range(),
      nodes.ghost_indices(),
      nodes.get_mpi_communicator());
    for (unsigned int i = 0; i < owned.size(); ++i)
      vector.local_element(i) = owned[i];
    vector.update_ghost_values();
    std::vector<unsigned int> all(owned);
    for (unsigned int i = 0; i < nodes.n_ghost_indices(); ++i)
      all.push_back(vector.local_element(owned.size() + i));
    return all;
  }
} // namespace Catena

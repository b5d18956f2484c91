#include <catena/base/node_dofs.h>
#include <catena/flow/node_matrix.h>

#include <algorithm>
#include <numeric>

namespace Catena
{
  using namespace dealii;

  NodeMatrix::NodeMatrix(const SparseRows                  &global_rows,
                         std::shared_ptr<const Partitioner> column_nodes)
    : nodes(std::move(column_nodes))
  {
    reserve(global_rows.starts);
    for (unsigned int i = 0; i < global_rows.size(); ++i)
      {
        for (unsigned int k = global_rows.starts[i];
             k < global_rows.starts[i + 1];
             ++k)
          rows.add(nodes->global_to_local(global_rows.columns[k]),
                   global_rows.values[k]);
        end_row();
      }
  }



  NodeMatrix::NodeMatrix(const BlockPattern       &pattern,
                         const std::vector<float> &entries)
    : nodes(pattern.column_nodes())
  {
    reserve(pattern.row_starts());
    for (unsigned int i = 0; i < pattern.n_rows(); ++i)
      {
        for (unsigned int k = pattern.row_start(i);
             k < pattern.row_start(i + 1);
             ++k)
          rows.add(pattern.local_columns()[k], entries[k]);
        end_row();
      }
  }



  void
  NodeMatrix::reserve(const std::vector<unsigned int> &starts)
  {
    unsigned int n_entries = 0;
    for (unsigned int i = 0; i + 1 < starts.size(); ++i)
      n_entries += (starts[i + 1] - starts[i] + stride - 1) / stride * stride;
    rows.starts.reserve(starts.size());
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
  NodeMatrix::diagonal(const unsigned int i) const
  {
    for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
      if (rows.columns[k] == i)
        return rows.values[k];
    return 0.f;
  }



  std::shared_ptr<const Utilities::MPI::Partitioner>
  make_nodes(const unsigned int                     n_owned,
             const std::vector<const SparseRows *> &rows,
             const MPI_Comm                         communicator)
  {
    const auto counts = Utilities::MPI::all_gather(communicator, n_owned);
    const auto own =
      counts.begin() + Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first = std::accumulate(counts.begin(), own, 0U),
                       size  = std::accumulate(own, counts.end(), first);
    IndexSet owned(size), ghosts(size);
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

#ifndef catena_benchmarks_whole_system_h
#define catena_benchmarks_whole_system_h

#include <catena/flow/flow_matrices.h>

#include <deal.II/lac/vector.h>

#include <metis.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sparse_matrix.h"

/**
 * The system of FlowMatrices as one matrix of the free unknowns, in an order
 * for incomplete or complete factors:
 *
 * - `metis`: the nodes by nested dissection, `rcm`: by reverse Cuthill-McKee,
 * - with the pressure of a node after its velocities, or all pressures last.
 *
 * The rigid-body unknowns come last, and the last pressure is zero.
 */
class WholeSystem
{
public:
  WholeSystem(const Catena::MovingMesh<3>                &mesh,
              const std::vector<Catena::NodeCoupling<3>> &couplings,
              const Catena::FlowMatrices<3>              &matrices,
              const std::string                          &order,
              const bool                                  pressures_last)
    : velocity_places(mesh.owned_vectors().size(), -1)
    , pressure_places(mesh.owned_scalars().size(), -1)
  {
    std::vector<int> nodes        = nodes_in_order(mesh, matrices, order);
    const auto       add_pressure = [&](const int node) {
      if (mesh.edge_ends(node)[0] == mesh.edge_ends(node)[1] &&
          mesh.identification().master(node) == static_cast<unsigned int>(node))
        {
          last_pressure                  = mesh.vertex_of_node(node);
          pressure_places[last_pressure] = n_places++;
        }
    };
    for (const int node : nodes)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (couplings[node].master == static_cast<unsigned int>(node) &&
              couplings[node].factors[d] != 0.)
            velocity_places[3 * node + d] = n_places++;
        if (!pressures_last)
          add_pressure(node);
      }
    if (pressures_last)
      for (const int node : nodes)
        add_pressure(node);
    remove_last_pressure();
    first_rigid = n_places;
    n_places += matrices.n_rigid();
  }

  unsigned int
  n() const
  {
    return n_places;
  }

  /// The vertex whose pressure is zero.
  unsigned int
  zero_pressure() const
  {
    return last_pressure;
  }

  void
  assemble(const Catena::FlowMatrices<3> &matrices,
           CompressedRows                &result) const
  {
    std::vector<std::vector<std::pair<int, double>>> rows(n_places);
    const auto identity = [this](const int k) { return first_rigid + k; };
    const auto velocity = [this](const int i) { return velocity_places[i]; };
    const auto pressure = [this](const int i) { return pressure_places[i]; };
    add(rows, matrices.velocity, velocity, velocity);
    add(rows, matrices.gradient, velocity, pressure);
    add(rows, matrices.divergence, pressure, velocity);
    add(rows, matrices.velocity_rigid, velocity, identity, false);
    add(rows, matrices.rigid_velocity_transposed, velocity, identity, true);
    add(rows, matrices.pressure_rigid, pressure, identity, false);
    add(rows, matrices.pressure_rigid, pressure, identity, true);
    for (unsigned int k = 0; k < matrices.n_rigid(); ++k)
      for (unsigned int l = 0; l < matrices.n_rigid(); ++l)
        rows[first_rigid + k].emplace_back(first_rigid + l,
                                           matrices.rigid_rigid(k, l));

    result = CompressedRows();
    for (auto &row : rows)
      {
        std::sort(row.begin(), row.end());
        for (const auto &entry : row)
          {
            result.columns.push_back(entry.first);
            result.values.push_back(entry.second);
          }
        result.row_starts.push_back(result.columns.size());
        row = {};
      }
  }

  dealii::Vector<double>
  gather(const Catena::BlockVectorType &blocks) const
  {
    dealii::Vector<double> result(n_places);
    for_all([&](const unsigned int b, const unsigned int i, const int place) {
      result(place) = blocks.block(b)(i);
    });
    return result;
  }

  void
  scatter(const dealii::Vector<double> &vector,
          Catena::BlockVectorType      &blocks) const
  {
    blocks = 0.;
    for_all([&](const unsigned int b, const unsigned int i, const int place) {
      blocks.block(b)(i) = vector(place);
    });
  }

private:
  /// by unknown; -1 if it is none
  std::vector<int> velocity_places, pressure_places;
  int              n_places = 0, first_rigid = 0, last_pressure = -1;

  template <typename Action>
  void
  for_all(const Action &action) const
  {
    for (unsigned int i = 0; i < velocity_places.size(); ++i)
      if (velocity_places[i] >= 0)
        action(0, i, velocity_places[i]);
    for (unsigned int i = 0; i < pressure_places.size(); ++i)
      if (pressure_places[i] >= 0)
        action(1, i, pressure_places[i]);
    for (int k = first_rigid; k < n_places; ++k)
      action(2, k - first_rigid, k);
  }

  void
  remove_last_pressure()
  {
    const int place                = pressure_places[last_pressure];
    pressure_places[last_pressure] = -1;
    for (auto *places : {&velocity_places, &pressure_places})
      for (int &p : *places)
        p -= p > place;
    --n_places;
  }

  // on one process, where local numbers are global ones
  template <int n_rows, int n_columns, typename RowPlace, typename ColumnPlace>
  static void
  add(std::vector<std::vector<std::pair<int, double>>>     &rows,
      const Catena::BlockMatrix<n_rows, n_columns, double> &matrix,
      const RowPlace                                       &row_place,
      const ColumnPlace                                    &column_place)
  {
    const Catena::BlockPattern &pattern = matrix.pattern();
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      for (unsigned int k = pattern.row_start(row);
           k < pattern.row_start(row + 1);
           ++k)
        for (int c = 0; c < n_columns; ++c)
          for (int r = 0; r < n_rows; ++r)
            {
              const int i = row_place(n_rows * row + r),
                        j = column_place(
                          n_columns * pattern.local_columns()[k] + c);
              const double value = matrix.block(k)[n_rows * c + r];
              if (i >= 0 && j >= 0 && value != 0.)
                rows[i].emplace_back(j, value);
            }
  }

  template <typename RowPlace, typename ColumnPlace>
  static void
  add(std::vector<std::vector<std::pair<int, double>>> &rows,
      const dealii::TrilinosWrappers::SparseMatrix     &matrix,
      const RowPlace                                   &row_place,
      const ColumnPlace                                &column_place,
      const bool                                        transposed)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    for (int row = 0; row < epetra.NumMyRows(); ++row)
      {
        const int i = row_place(epetra.GRID(row));
        if (i < 0)
          continue;
        int     n_entries, *columns;
        double *values;
        epetra.ExtractMyRowView(row, n_entries, values, columns);
        for (int k = 0; k < n_entries; ++k)
          {
            const int j = column_place(epetra.GCID(columns[k]));
            if (j < 0 || values[k] == 0.)
              continue;
            rows[transposed ? j : i].emplace_back(transposed ? i : j,
                                                  values[k]);
          }
      }
  }

  static std::vector<int>
  nodes_in_order(const Catena::MovingMesh<3>   &mesh,
                 const Catena::FlowMatrices<3> &matrices,
                 const std::string             &order)
  {
    const Catena::BlockPattern &pattern = matrices.velocity.pattern();
    const unsigned int          n       = mesh.n_global_nodes();
    std::vector<idx_t>          starts  = {0}, neighbours;
    for (unsigned int node = 0; node < n; ++node)
      {
        for (unsigned int k = pattern.row_start(node);
             k < pattern.row_start(node + 1);
             ++k)
          if (pattern.local_columns()[k] != node)
            neighbours.push_back(pattern.local_columns()[k]);
        starts.push_back(neighbours.size());
      }
    std::vector<idx_t> nodes(n), places(n);
    if (order == "metis")
      {
        idx_t n_nodes = n;
        METIS_NodeND(&n_nodes,
                     starts.data(),
                     neighbours.data(),
                     nullptr,
                     nullptr,
                     nodes.data(),
                     places.data());
      }
    else
      nodes = reverse_cuthill_mckee(starts, neighbours);
    return {nodes.begin(), nodes.end()};
  }

  static std::vector<idx_t>
  reverse_cuthill_mckee(const std::vector<idx_t> &starts,
                        const std::vector<idx_t> &neighbours)
  {
    const unsigned int n      = starts.size() - 1;
    const auto         degree = [&](const idx_t i) {
      return starts[i + 1] - starts[i];
    };
    std::vector<char>  found(n, 0);
    std::vector<idx_t> nodes;
    for (unsigned int seed = 0; seed < n; ++seed)
      {
        if (found[seed])
          continue;
        found[seed] = 1;
        nodes.push_back(seed);
        for (std::size_t next = nodes.size() - 1; next < nodes.size(); ++next)
          {
            const idx_t       i     = nodes[next];
            const std::size_t first = nodes.size();
            for (idx_t k = starts[i]; k < starts[i + 1]; ++k)
              if (!found[neighbours[k]])
                {
                  found[neighbours[k]] = 1;
                  nodes.push_back(neighbours[k]);
                }
            std::sort(nodes.begin() + first,
                      nodes.end(),
                      [&](const idx_t a, const idx_t b) {
                        return degree(a) < degree(b);
                      });
          }
      }
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }
};

#endif

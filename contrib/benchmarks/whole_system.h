#ifndef catena_benchmarks_whole_system_h
#define catena_benchmarks_whole_system_h

#include <catena/flow/node_couplings.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <metis.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "element_matrix.h"
#include "sparse_matrix.h"

/**
 * The system of FlowSystem as one matrix of the free unknowns, on one process,
 * in an order for incomplete or complete factors:
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
              const unsigned int                          n_rigid,
              const std::string                          &order,
              const bool                                  pressures_last)
    : mesh(mesh)
    , velocity_places(mesh.owned_vectors().size(), -1)
    , pressure_places(mesh.owned_scalars().size(), -1)
  {
    const std::vector<int> nodes = nodes_in_order(mesh, couplings, order);
    const auto             add_pressure = [&](const int node) {
      if (mesh.is_vertex(node) &&
          mesh.identification().master(node) == static_cast<unsigned int>(node))
        {
          last_pressure = mesh.vertex_of_node(node);
          pressure_places[last_pressure] = n_places++;
        }
    };
    for (const int node : nodes)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (couplings[node].is_unknown(node, d))
            velocity_places[3 * node + d] = n_places++;
        if (!pressures_last)
          add_pressure(node);
      }
    if (pressures_last)
      for (const int node : nodes)
        add_pressure(node);
    remove_last_pressure();
    first_rigid = n_places;
    n_places += n_rigid;
  }

  /// A matrix of zeros.
  CompressedRows
  pattern(const std::vector<Catena::NodeCoupling<3>> &couplings) const
  {
    dealii::DynamicSparsityPattern pairs(n_places, n_places);
    for (const auto &cell : mesh.cells())
      {
        const std::vector<int> all = CellPlaces(*this, cell, couplings).all;
        const std::vector<dealii::types::global_dof_index> places(all.begin(),
                                                                  all.end());
        for (const auto row : places)
          pairs.add_entries(row, places.begin(), places.end(), true);
      }
    CompressedRows matrix;
    for (int row = 0; row < n_places; ++row)
      {
        for (auto it = pairs.begin(row); it != pairs.end(row); ++it)
          matrix.columns.push_back(it->column());
        matrix.row_starts.push_back(matrix.columns.size());
      }
    matrix.values.assign(matrix.columns.size(), 0.);
    return matrix;
  }

  /// @param matrix with the pattern
  void
  assemble(const std::vector<Catena::NodeCoupling<3>> &couplings,
           const Catena::StressModel<3>               &stress,
           CompressedRows                             &matrix) const
  {
    std::fill(matrix.values.begin(), matrix.values.end(), 0.);
    Catena::CellValues<3>                      values;
    std::vector<Catena::StressCoefficients<3>> coefficients;
    ElementMatrix                              element;
    std::vector<double>                        condensed;
    for (const auto &cell : mesh.cells())
      {
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        stress.evaluate(cell, values, coefficients);
        element.integrate(values.points(), coefficients);

        const CellPlaces   places(*this, cell, couplings);
        const unsigned int m = places.all.size();
        condensed.assign(m * m, 0.);
        for (unsigned int i = 0; i < ElementMatrix::n; ++i)
          for (const auto &row : places.of_unknown[i])
            for (unsigned int j = 0; j < ElementMatrix::n; ++j)
              for (const auto &column : places.of_unknown[j])
                condensed[m * row.place + column.place] +=
                  row.factor * column.factor * element.entries[i][j];
        for (unsigned int i = 0; i < m; ++i)
          {
            unsigned long k = matrix.row_starts[places.all[i]];
            for (unsigned int j = 0; j < m; ++j, ++k)
              {
                while (matrix.columns[k] != places.all[j])
                  ++k;
                matrix.values[k] += condensed[m * i + j];
              }
          }
      }
  }

  /// The vertex whose pressure is zero.
  unsigned int
  zero_pressure() const
  {
    return last_pressure;
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
  /// What unknowns the velocities and pressures of a cell stand for.
  struct CellPlaces
  {
    struct Share
    {
      /// among all
      unsigned int place;
      double       factor;
    };
    /// in ascending order
    std::vector<int>                                 all;
    std::array<std::vector<Share>, ElementMatrix::n> of_unknown;

    CellPlaces(const WholeSystem                          &system,
               const Catena::MovingMesh<3>::Cell          &cell,
               const std::vector<Catena::NodeCoupling<3>> &couplings)
    {
      std::array<std::vector<std::pair<int, double>>, ElementMatrix::n> shares;
      for (unsigned int a = 0; a < ElementMatrix::n_nodes; ++a)
        {
          const auto &coupling = couplings[cell.nodes[a]];
          for (unsigned int d = 0; d < 3; ++d)
            if (coupling.factors[d] != 0.)
              shares[3 * a + d].emplace_back(
                system.velocity_places[3 * coupling.master + d],
                coupling.factors[d]);
          for (const auto &motion : coupling.motions)
            shares[3 * a + motion.component].emplace_back(system.first_rigid +
                                                            motion.unknown,
                                                          motion.factor);
        }
      for (unsigned int v = 0; v < ElementMatrix::n_vertices; ++v)
        {
          const int place =
            system.pressure_places[system.mesh.vertex_master(cell.vertices[v])];
          if (place >= 0)
            shares[3 * ElementMatrix::n_nodes + v].emplace_back(place, 1.);
        }
      for (const auto &some : shares)
        for (const auto &share : some)
          all.push_back(share.first);
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      for (unsigned int i = 0; i < ElementMatrix::n; ++i)
        for (const auto &share : shares[i])
          of_unknown[i].push_back(
            {static_cast<unsigned int>(
               std::lower_bound(all.begin(), all.end(), share.first) -
               all.begin()),
             share.second});
    }
  };

  const Catena::MovingMesh<3> &mesh;
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

  static std::vector<int>
  nodes_in_order(const Catena::MovingMesh<3>                &mesh,
                 const std::vector<Catena::NodeCoupling<3>> &couplings,
                 const std::string                          &order)
  {
    const unsigned int             n = mesh.n_global_nodes();
    dealii::DynamicSparsityPattern pairs(n, n);
    for (const auto &cell : mesh.cells())
      for (const unsigned int a : cell.nodes)
        for (const unsigned int b : cell.nodes)
          if (couplings[a].has_unknown() && couplings[b].has_unknown())
            pairs.add(couplings[a].master, couplings[b].master);
    std::vector<idx_t> starts = {0}, neighbours;
    for (unsigned int node = 0; node < n; ++node)
      {
        for (auto it = pairs.begin(node); it != pairs.end(node); ++it)
          if (it->column() != node)
            neighbours.push_back(it->column());
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

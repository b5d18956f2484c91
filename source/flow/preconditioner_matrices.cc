#include <catena/flow/preconditioner_matrices.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <utility>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Whose equation a node's part belongs to.
    template <int dim>
    unsigned int
    master_or_absent(const NodeCoupling<dim> &coupling)
    {
      return coupling.has_unknown() ? coupling.master : CellNodes::absent;
    }



    /**
     * The columns of a cell in a pattern, in the order in which its rows have
     * them.
     */
    template <std::size_t n>
    class PatternPlaces
    {
    public:
      /// @param columns nodes, or absent
      PatternPlaces(const BlockPattern                &pattern,
                    const std::array<unsigned int, n> &columns)
        : pattern(pattern)
      {
        const auto &nodes = *pattern.column_nodes();
        for (unsigned int i = 0; i < n; ++i)
          if (columns[i] != CellNodes::absent)
            insert({nodes.global_to_local(columns[i]), i});
      }

      /// Call @p action with the number of each column and of its block.
      template <typename Action>
      void
      in_row(const unsigned int row, const Action &action) const
      {
        unsigned int k = pattern.row_start(row);
        for (unsigned int i = 0; i < size; ++i)
          {
            while (pattern.local_columns()[k] != places[i].first)
              ++k;
            Assert(k < pattern.row_start(row + 1), ExcInternalError());
            action(places[i].second, k);
          }
      }

    private:
      /// A column and its number in the cell.
      using Place = std::pair<unsigned int, unsigned int>;

      const BlockPattern  &pattern;
      std::array<Place, n> places;
      unsigned int         size = 0;

      void
      insert(const Place &place)
      {
        unsigned int i = size++;
        for (; i > 0 && place < places[i - 1]; --i)
          places[i] = places[i - 1];
        places[i] = place;
      }
    };
  } // namespace



  template <int dim>
  PreconditionerMatrices<dim>::PreconditionerMatrices(
    const MovingMesh<dim>                &mesh,
    const std::vector<NodeCoupling<dim>> &couplings)
    : mesh(mesh)
    , couplings(couplings)
  {
    make_patterns();
    group_components();
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::make_patterns()
  {
    CellNodes masters{n_nodes}, vertices{n_vertices};
    masters.nodes.reserve(n_nodes * mesh.cells().size());
    vertices.nodes.reserve(n_vertices * mesh.cells().size());
    for (const auto &cell : mesh.cells())
      {
        for (const unsigned int node : cell.nodes)
          masters.nodes.push_back(master_or_absent(couplings[node]));
        for (const unsigned int vertex : cell.vertices)
          vertices.nodes.push_back(mesh.vertex_master(vertex));
      }
    const MPI_Comm comm = mesh.communicator();
    gradient            = BlockMatrix<dim>(std::make_shared<const BlockPattern>(
      mesh.owned_nodes(), mesh.owned_scalars(), masters, vertices, comm));

    // what is not solved for has an equation of its own
    const auto add_alone = [](CellNodes &cells, const unsigned int node) {
      cells.nodes.push_back(node);
      cells.nodes.resize(cells.nodes.size() + cells.n_nodes - 1,
                         CellNodes::absent);
    };
    for (const auto node : mesh.owned_nodes())
      if (couplings[node].master != node || !couplings[node].has_unknown())
        add_alone(masters, node);
    for (const auto vertex : mesh.owned_scalars())
      if (mesh.vertex_master(vertex) != vertex)
        add_alone(vertices, vertex);
    node_pattern = std::make_shared<const BlockPattern>(
      mesh.owned_nodes(), mesh.owned_nodes(), masters, masters, comm);
    pressure_mass = BlockMatrix<1>(std::make_shared<const BlockPattern>(
      mesh.owned_scalars(), mesh.owned_scalars(), vertices, vertices, comm));
  }



  /// Has a component the factors of others wherever both have an unknown?
  template <int dim>
  bool
  PreconditionerMatrices<dim>::share_operator(
    const std::vector<unsigned int> &components,
    const unsigned int               component) const
  {
    bool equal = true;
    for (const auto node : mesh.relevant_nodes())
      for (const unsigned int d : components)
        {
          const double product =
            couplings[node].factors[d] * couplings[node].factors[component];
          equal &= product >= 0.;
        }
    return Utilities::MPI::min(equal ? 1 : 0, mesh.communicator()) == 1;
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::group_components()
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        bool is_new = true;
        for (ComponentMatrix &group : component_matrices)
          if (is_new && share_operator(group.components, d))
            {
              group.components.push_back(d);
              is_new = false;
            }
        if (is_new)
          component_matrices.push_back({{d}, {}});
      }
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::clear()
  {
    gradient.clear();
    pressure_mass.clear();
    for (ComponentMatrix &component : component_matrices)
      component.entries.assign(node_pattern->n_blocks(), 0.f);
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::release_components()
  {
    for (ComponentMatrix &component : component_matrices)
      component.entries = std::vector<float>();
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::add(const unsigned int                c,
                                   const PreconditionerElement<dim> &element)
  {
    const auto &cell = mesh.cells()[c];
    // without a row the columns may be none of this rank's
    const auto is_absent = [](const unsigned int row) {
      return row == BlockPattern::absent;
    };

    std::array<unsigned int, n_vertices> vertices, vertex_rows;
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        vertices[v]    = mesh.vertex_master(cell.vertices[v]);
        vertex_rows[v] = pressure_mass.pattern().row(vertices[v]);
      }
    if (!std::all_of(vertex_rows.begin(), vertex_rows.end(), is_absent))
      {
        const PatternPlaces<n_vertices> places(pressure_mass.pattern(),
                                               vertices);
        for (unsigned int v = 0; v < n_vertices; ++v)
          if (!is_absent(vertex_rows[v]))
            places.in_row(vertex_rows[v],
                          [&](const unsigned int w, const unsigned int k) {
                            pressure_mass.block(k)[0] += element.mass[v][w];
                          });
      }

    const unsigned int n_groups = component_matrices.size();
    std::array<std::array<double, n_nodes>, dim> factors;
    std::array<unsigned int, n_nodes>            masters, rows;
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const NodeCoupling<dim> &coupling = couplings[cell.nodes[a]];
        masters[a]                        = master_or_absent(coupling);
        rows[a]                           = node_pattern->row(masters[a]);
        for (unsigned int g = 0; g < n_groups; ++g)
          factors[g][a] =
            coupling.shared_factor(component_matrices[g].components);
      }
    if (std::all_of(rows.begin(), rows.end(), is_absent))
      return;
    const PatternPlaces<n_nodes>    nodes(*node_pattern, masters);
    const PatternPlaces<n_vertices> pressures(gradient.pattern(), vertices);

    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const unsigned int row = rows[a];
        if (is_absent(row))
          continue;
        const NodeCoupling<dim> &test = couplings[cell.nodes[a]];
        pressures.in_row(row, [&](const unsigned int v, const unsigned int k) {
          for (unsigned int d = 0; d < dim; ++d)
            gradient.block(k)[d] +=
              test.factors[d] * element.gradient[v].components[d][a];
        });
        nodes.in_row(row, [&](const unsigned int b, const unsigned int k) {
          for (unsigned int g = 0; g < n_groups; ++g)
            component_matrices[g].entries[k] +=
              factors[g][a] * factors[g][b] * element.component[a][b];
        });
      }
  }



  template <int dim>
  void
  PreconditionerMatrices<dim>::finish()
  {
    for (const auto node : mesh.owned_nodes())
      for (ComponentMatrix &group : component_matrices)
        if (couplings[node].master != node ||
            couplings[node].shared_factor(group.components) == 0.)
          {
            const unsigned int row = node_pattern->row(node);
            group.entries[node_pattern->row_start(row) +
                          node_pattern->offset(row, node)] += 1.f;
          }
    for (const auto vertex : mesh.owned_scalars())
      if (mesh.vertex_master(vertex) != vertex)
        {
          const unsigned int row = pressure_mass.pattern().row(vertex);
          pressure_mass.block(row,
                              pressure_mass.pattern().offset(row, vertex))[0] +=
            1.f;
        }
  }



  template class PreconditionerMatrices<2>;
  template class PreconditionerMatrices<3>;
} // namespace Catena

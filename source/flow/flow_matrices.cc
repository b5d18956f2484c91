#include <catena/flow/flow_matrices.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  /**
   * The matrices of one cell before constraints, by node and component.
   */
  template <int dim>
  struct FlowMatrices<dim>::Element
  {
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    using Block = std::array<double, dim * dim>;

    const typename MovingMesh<dim>::Cell *cell;
    std::array<const NodeCoupling<dim> *, n_nodes> couplings;
    bool                                           touches_particle;

    std::array<std::array<Block, n_nodes>, n_nodes>                 velocity;
    std::array<std::array<Tensor<1, dim>, n_nodes>, n_vertices>     divergence;
    std::array<Tensor<1, dim>, n_nodes>                             rhs;
    std::array<std::array<double, n_nodes>, n_nodes>                component;
    std::array<std::array<double, n_vertices>, n_vertices>          mass;
    std::array<double, n_vertices>                                  volume;

    void
    reset(const typename MovingMesh<dim>::Cell         &new_cell,
          const std::vector<NodeCoupling<dim>> &all_couplings)
    {
      cell             = &new_cell;
      touches_particle = false;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          couplings[a] = &all_couplings[new_cell.nodes[a]];
          touches_particle |= couplings[a]->rigid;
        }
      velocity   = {};
      divergence = {};
      rhs        = {};
      component  = {};
      mass       = {};
      volume     = {};
    }

    /// K u + B^T p = F, integrated at one point.
    void
    add(const typename CellValues<dim>::PointValues &point,
        const StressCoefficients<dim>               &coefficients,
        const Tensor<2, dim>                        &imposed_gradient)
    {
      std::array<Tensor<1, dim>, n_nodes> flux;
      for (unsigned int b = 0; b < n_nodes; ++b)
        flux[b] = point.JxW * (coefficients.viscosity *
                               point.quadratic_gradient[b]);

      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, dim> &gradient = point.quadratic_gradient[a];
          for (unsigned int b = 0; b < n_nodes; ++b)
            {
              Block       &block    = velocity[a][b];
              const double diagonal = gradient * flux[b];
              component[a][b] += diagonal;
              for (unsigned int i = 0; i < dim; ++i)
                {
                  for (unsigned int j = 0; j < dim; ++j)
                    block[dim * i + j] += gradient[j] * flux[b][i];
                  block[(dim + 1) * i] += diagonal;
                }
            }
        }

      const SymmetricTensor<2, dim> imposed_stress =
        coefficients.stress(imposed_gradient);
      for (unsigned int a = 0; a < n_nodes; ++a)
        rhs[a] -= point.JxW * (imposed_stress * point.quadratic_gradient[a]);

      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int b = 0; b < n_nodes; ++b)
          divergence[v][b] -=
            point.JxW * point.linear[v] * point.quadratic_gradient[b];

      const double fluidity = dim / trace(coefficients.viscosity);
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          volume[v] += point.JxW * point.linear[v];
          for (unsigned int w = 0; w < n_vertices; ++w)
            mass[v][w] +=
              point.JxW * fluidity * point.linear[v] * point.linear[w];
        }
    }

    void
    add_body_force(const typename CellValues<dim>::PointValues   &point,
                   const typename CellValues<dim>::NodePositions &positions,
                   const Function<dim>                           &force)
    {
      Point<dim> x;
      for (unsigned int a = 0; a < n_nodes; ++a)
        x += point.quadratic[a] * Tensor<1, dim>(positions[a]);
      for (unsigned int i = 0; i < dim; ++i)
        {
          const double f = point.JxW * force.value(x, i);
          for (unsigned int a = 0; a < n_nodes; ++a)
            rhs[a][i] += f * point.quadratic[a];
        }
    }

    /// Right-hand side without the part of known velocities.
    void
    condense_known_velocities()
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              rhs[a][i] -=
                velocity[a][b][dim * i + j] * couplings[b]->known[j];
    }
  };



  template <int dim>
  FlowMatrices<dim>::FlowMatrices(
    const MovingMesh<dim>                &mesh,
    const RigidBodies<dim>               &bodies,
    const std::vector<NodeCoupling<dim>> &couplings)
    : rigid_rigid(bodies.n_unknowns())
    , velocity_rhs(mesh.owned_vectors(), mesh.communicator())
    , pressure_rhs(mesh.owned_scalars(), mesh.communicator())
    , rigid_rhs(bodies.n_unknowns())
    , vertex_volumes(mesh.owned_scalars(), mesh.communicator())
    , mesh(mesh)
    , bodies(bodies)
    , rigid_owned(bodies.n_unknowns())
    , rigid_relevant(bodies.n_unknowns())
  {
    rigid_relevant.add_range(0, bodies.n_unknowns());
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      rigid_owned.add_range(0, bodies.n_unknowns());
    make_patterns(couplings);
  }



  template <int dim>
  unsigned int
  FlowMatrices<dim>::pressure_master(const unsigned int vertex) const
  {
    return mesh.vertex_of_node(
      mesh.identification().master(mesh.node_of_vertex(vertex)));
  }



  template <int dim>
  void
  FlowMatrices<dim>::make_patterns(
    const std::vector<NodeCoupling<dim>> &couplings)
  {
    const unsigned int n_nodes    = mesh.n_global_nodes();
    const unsigned int n_vertices = mesh.scalar_dofs().n_dofs();
    const unsigned int n_rigid    = bodies.n_unknowns();

    DynamicSparsityPattern nodes(n_nodes, n_nodes, mesh.relevant_nodes());
    DynamicSparsityPattern divergences(n_vertices,
                                       dim * n_nodes,
                                       mesh.relevant_scalars());
    DynamicSparsityPattern gradients(dim * n_nodes,
                                     n_vertices,
                                     mesh.relevant_vectors());
    DynamicSparsityPattern masses(n_vertices,
                                  n_vertices,
                                  mesh.relevant_scalars());
    DynamicSparsityPattern velocity_motions(dim * n_nodes,
                                            n_rigid,
                                            mesh.relevant_vectors());
    DynamicSparsityPattern pressure_motions(n_vertices,
                                            n_rigid,
                                            mesh.relevant_scalars());

    for (const auto vertex : mesh.owned_scalars())
      masses.add(vertex, vertex);

    std::vector<types::global_dof_index> masters, columns, vertices;
    for (const auto &cell : mesh.cells())
      {
        masters.clear();
        columns.clear();
        vertices.clear();
        std::vector<unsigned int> motions;
        for (const unsigned int node : cell.nodes)
          {
            if (couplings[node].rigid)
              {
                const auto range = bodies.range(mesh.particle(node));
                for (unsigned int k = range.first; k < range.second; ++k)
                  motions.push_back(k);
              }
            if (couplings[node].has_unknown())
              masters.push_back(couplings[node].master);
          }
        std::sort(masters.begin(), masters.end());
        masters.erase(std::unique(masters.begin(), masters.end()),
                      masters.end());
        for (const auto master : masters)
          for (unsigned int d = 0; d < dim; ++d)
            columns.push_back(dim * master + d);
        for (const unsigned int vertex : cell.vertices)
          vertices.push_back(pressure_master(vertex));
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()),
                       vertices.end());

        for (const auto master : masters)
          nodes.add_entries(master, masters.begin(), masters.end(), true);
        for (const auto row : columns)
          {
            gradients.add_entries(row, vertices.begin(), vertices.end(), true);
            for (const unsigned int k : motions)
              velocity_motions.add(row, k);
          }
        for (const auto vertex : vertices)
          {
            divergences.add_entries(vertex,
                                    columns.begin(),
                                    columns.end(),
                                    true);
            masses.add_entries(vertex, vertices.begin(), vertices.end(), true);
            for (const unsigned int k : motions)
              pressure_motions.add(vertex, k);
          }
      }

    for (const auto node : mesh.owned_nodes())
      nodes.add(node, node);
    DynamicSparsityPattern velocities(dim * n_nodes,
                                      dim * n_nodes,
                                      mesh.relevant_vectors());
    for (const auto node : mesh.owned_nodes())
      {
        columns.clear();
        for (auto it = nodes.begin(node); it != nodes.end(node); ++it)
          for (unsigned int d = 0; d < dim; ++d)
            columns.push_back(dim * it->column() + d);
        for (unsigned int d = 0; d < dim; ++d)
          velocities.add_entries(dim * node + d,
                                 columns.begin(),
                                 columns.end(),
                                 true);
      }

    const MPI_Comm comm = mesh.communicator();
    velocity.reinit(mesh.owned_vectors(), mesh.owned_vectors(), velocities, comm);
    velocity_access =
      CsrAccess(velocity, mesh.owned_vectors(), mesh.relevant_vectors());
    gradient.reinit(mesh.owned_vectors(), mesh.owned_scalars(), gradients, comm);
    gradient_access =
      CsrAccess(gradient, mesh.owned_vectors(), mesh.relevant_scalars());
    divergence.reinit(mesh.owned_scalars(),
                      mesh.owned_vectors(),
                      divergences,
                      comm);
    divergence_access =
      CsrAccess(divergence, mesh.owned_scalars(), mesh.relevant_vectors());
    pressure_mass.reinit(mesh.owned_scalars(),
                         mesh.owned_scalars(),
                         masses,
                         comm);
    mass_access =
      CsrAccess(pressure_mass, mesh.owned_scalars(), mesh.relevant_scalars());
    if (n_rigid > 0)
      {
        velocity_rigid.reinit(mesh.owned_vectors(),
                              rigid_owned,
                              velocity_motions,
                              comm);
        velocity_rigid_access =
          CsrAccess(velocity_rigid, mesh.owned_vectors(), rigid_relevant);
        rigid_velocity_transposed.reinit(mesh.owned_vectors(),
                                         rigid_owned,
                                         velocity_motions,
                                         comm);
        rigid_velocity_access = CsrAccess(rigid_velocity_transposed,
                                          mesh.owned_vectors(),
                                          rigid_relevant);
        pressure_rigid.reinit(mesh.owned_scalars(),
                              rigid_owned,
                              pressure_motions,
                              comm);
        pressure_rigid_access =
          CsrAccess(pressure_rigid, mesh.owned_scalars(), rigid_relevant);
      }
    make_component_matrices(couplings, nodes);
    find_offsets(couplings);
  }



  template <int dim>
  void
  FlowMatrices<dim>::find_offsets(
    const std::vector<NodeCoupling<dim>> &couplings)
  {
    offsets.assign(mesh.cells().size(), Offsets());
    for (unsigned int c = 0; c < offsets.size(); ++c)
      {
        const auto &cell = mesh.cells()[c];
        for (unsigned int b = 0; b < Offsets::n_nodes; ++b)
          {
            const NodeCoupling<dim> &trial = couplings[cell.nodes[b]];
            if (!trial.has_unknown())
              continue;
            for (unsigned int a = 0; a < Offsets::n_nodes; ++a)
              {
                const NodeCoupling<dim> &test = couplings[cell.nodes[a]];
                const int row = velocity_access.row(dim * test.master);
                if (test.has_unknown() && row != CsrAccess::absent)
                  offsets[c].velocity[a][b] = velocity_access.offset(
                    row, velocity_access.column(dim * trial.master));
              }
            const int gradient_row = gradient_access.row(dim * trial.master);
            for (unsigned int v = 0; v < Offsets::n_vertices; ++v)
              {
                const unsigned int vertex = pressure_master(cell.vertices[v]);
                const int          row    = divergence_access.row(vertex);
                if (row != CsrAccess::absent)
                  offsets[c].divergence[v][b] = divergence_access.offset(
                    row, divergence_access.column(dim * trial.master));
                if (gradient_row != CsrAccess::absent)
                  offsets[c].gradient[v][b] = gradient_access.offset(
                    gradient_row, gradient_access.column(vertex));
              }
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::make_component_matrices(
    const std::vector<NodeCoupling<dim>> &couplings,
    const DynamicSparsityPattern         &nodes)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        int as_before = d > 0 ? 1 : 0;
        for (const auto node : mesh.relevant_nodes())
          if (d > 0 &&
              couplings[node].factors[d] != couplings[node].factors[d - 1])
            as_before = 0;
        if (Utilities::MPI::min(as_before, mesh.communicator()) == 0)
          {
            auto component = std::make_unique<ComponentMatrix>();
            component->matrix.reinit(mesh.owned_nodes(),
                                     mesh.owned_nodes(),
                                     nodes,
                                     mesh.communicator());
            component->access = CsrAccess(component->matrix,
                                          mesh.owned_nodes(),
                                          mesh.relevant_nodes());
            component_matrices.push_back(std::move(component));
          }
        component_matrices.back()->components.push_back(d);
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::assemble(const std::vector<NodeCoupling<dim>> &couplings,
                              const StressModel<dim>               &stress,
                              const Tensor<2, dim> &imposed_gradient,
                              const bool            with_preconditioner,
                              const Function<dim>  *body_force)
  {
    velocity   = 0.;
    gradient   = 0.;
    divergence = 0.;
    if (n_rigid() > 0)
      {
        velocity_rigid            = 0.;
        rigid_velocity_transposed = 0.;
        pressure_rigid            = 0.;
      }
    rigid_rigid    = 0.;
    velocity_rhs   = 0.;
    pressure_rhs   = 0.;
    vertex_volumes = 0.;
    std::fill(rigid_rhs.begin(), rigid_rhs.end(), 0.);
    if (with_preconditioner)
      {
        pressure_mass = 0.;
        for (const auto &component : component_matrices)
          component->matrix = 0.;
      }

    CellValues<dim> standard_values, precise_values(
      QWitherdenVincentSimplex<dim>(3));
    CellValues<dim> &values = body_force ? precise_values : standard_values;
    std::vector<StressCoefficients<dim>> coefficients;
    Element                              element;
    for (unsigned int c = 0; c < mesh.cells().size(); ++c)
      {
        const auto &cell      = mesh.cells()[c];
        const auto  positions = mesh.cell_positions(cell, mesh.positions());
        values.reinit(positions, cell.curved);
        stress.evaluate(cell, values, coefficients);

        element.reset(cell, couplings);
        for (unsigned int q = 0; q < coefficients.size(); ++q)
          {
            element.add(values.points()[q], coefficients[q], imposed_gradient);
            if (body_force)
              element.add_body_force(values.points()[q],
                                     positions,
                                     *body_force);
          }
        if (element.touches_particle)
          element.condense_known_velocities();

        add_velocity_block(element, offsets[c]);
        add_pressure_blocks(element, offsets[c]);
        add_right_hand_side(element);
        if (element.touches_particle)
          add_rigid_blocks(element);
        if (with_preconditioner)
          add_preconditioner(element);
      }
    finish(couplings, with_preconditioner);
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_velocity_block(const Element &element,
                                        const Offsets &offset)
  {
    for (unsigned int a = 0; a < Element::n_nodes; ++a)
      {
        const NodeCoupling<dim> &test = *element.couplings[a];
        const int row = velocity_access.row(dim * test.master);
        if (!test.has_unknown() || row == CsrAccess::absent)
          continue;
        for (unsigned int b = 0; b < Element::n_nodes; ++b)
          {
            if (!element.couplings[b]->has_unknown())
              continue;
            const auto &trial = element.couplings[b]->factors;
            const auto &block = element.velocity[a][b];
            for (unsigned int i = 0; i < dim; ++i)
              {
                double *entries =
                  velocity_access.values(row + i) + offset.velocity[a][b];
                for (unsigned int j = 0; j < dim; ++j)
                  entries[j] += test.factors[i] * block[dim * i + j] * trial[j];
              }
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_pressure_blocks(const Element &element,
                                         const Offsets &offset)
  {
    for (unsigned int v = 0; v < Element::n_vertices; ++v)
      {
        const unsigned int master = pressure_master(element.cell->vertices[v]);
        const int          row    = divergence_access.row(master);
        for (unsigned int b = 0; b < Element::n_nodes; ++b)
          {
            const NodeCoupling<dim> &node = *element.couplings[b];
            if (!node.has_unknown())
              continue;
            const Tensor<1, dim> &value = element.divergence[v][b];
            if (row != CsrAccess::absent)
              {
                double *entries =
                  divergence_access.values(row) + offset.divergence[v][b];
                for (unsigned int j = 0; j < dim; ++j)
                  entries[j] += value[j] * node.factors[j];
              }
            const int gradient_row = gradient_access.row(dim * node.master);
            if (gradient_row != CsrAccess::absent)
              for (unsigned int j = 0; j < dim; ++j)
                gradient_access.values(
                  gradient_row + j)[offset.gradient[v][b]] +=
                  value[j] * node.factors[j];
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_right_hand_side(const Element &element)
  {
    for (unsigned int a = 0; a < Element::n_nodes; ++a)
      {
        const NodeCoupling<dim> &node = *element.couplings[a];
        if (node.has_unknown() &&
            mesh.owned_vectors().is_element(dim * node.master))
          for (unsigned int i = 0; i < dim; ++i)
            velocity_rhs(dim * node.master + i) +=
              node.factors[i] * element.rhs[a][i];
        if (node.rigid && element.cell->owned)
          for (unsigned int i = 0; i < dim; ++i)
            for (const auto &motion : node.motions[i])
              rigid_rhs[motion.first] += motion.second * element.rhs[a][i];
      }
    for (unsigned int v = 0; v < Element::n_vertices; ++v)
      {
        const unsigned int master = pressure_master(element.cell->vertices[v]);
        if (!mesh.owned_scalars().is_element(master))
          continue;
        vertex_volumes(master) += element.volume[v];
        if (element.touches_particle)
          for (unsigned int b = 0; b < Element::n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              pressure_rhs(master) -=
                element.divergence[v][b][j] * element.couplings[b]->known[j];
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_rigid_blocks(const Element &element)
  {
    for (unsigned int b = 0; b < Element::n_nodes; ++b)
      for (unsigned int j = 0; j < dim; ++j)
        for (const auto &motion : element.couplings[b]->motions[j])
          {
            for (unsigned int a = 0; a < Element::n_nodes; ++a)
              {
                const NodeCoupling<dim> &node = *element.couplings[a];
                if (node.rigid && element.cell->owned)
                  {
                    for (unsigned int i = 0; i < dim; ++i)
                      for (const auto &test : node.motions[i])
                        rigid_rigid(test.first, motion.first) +=
                          test.second * motion.second *
                          element.velocity[a][b][dim * i + j];
                  }
                if (!node.has_unknown())
                  continue;
                const int row = velocity_rigid_access.row(dim * node.master);
                if (row == CsrAccess::absent)
                  continue;
                const int column = velocity_rigid_access.column(motion.first);
                const int column_transposed =
                  rigid_velocity_access.column(motion.first);
                for (unsigned int i = 0; i < dim; ++i)
                  {
                    velocity_rigid_access.add(
                      row + i,
                      column,
                      node.factors[i] * motion.second *
                        element.velocity[a][b][dim * i + j]);
                    rigid_velocity_access.add(
                      row + i,
                      column_transposed,
                      node.factors[i] * motion.second *
                        element.velocity[b][a][dim * j + i]);
                  }
              }
            for (unsigned int v = 0; v < Element::n_vertices; ++v)
              {
                const int row = pressure_rigid_access.row(
                  pressure_master(element.cell->vertices[v]));
                if (row != CsrAccess::absent)
                  pressure_rigid_access.add(
                    row,
                    pressure_rigid_access.column(motion.first),
                    motion.second * element.divergence[v][b][j]);
              }
          }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_preconditioner(const Element &element)
  {
    for (unsigned int v = 0; v < Element::n_vertices; ++v)
      {
        const int row =
          mass_access.row(pressure_master(element.cell->vertices[v]));
        if (row == CsrAccess::absent)
          continue;
        for (unsigned int w = 0; w < Element::n_vertices; ++w)
          mass_access.add(row,
                          mass_access.column(
                            pressure_master(element.cell->vertices[w])),
                          element.mass[v][w]);
      }
    for (const auto &component : component_matrices)
      {
        const unsigned int d = component->components[0];
        for (unsigned int a = 0; a < Element::n_nodes; ++a)
          {
            const NodeCoupling<dim> &test = *element.couplings[a];
            if (test.factors[d] == 0.)
              continue;
            const int row = component->access.row(test.master);
            if (row == CsrAccess::absent)
              continue;
            for (unsigned int b = 0; b < Element::n_nodes; ++b)
              {
                const NodeCoupling<dim> &trial = *element.couplings[b];
                if (trial.factors[d] != 0.)
                  component->access.add(row,
                                        component->access.column(trial.master),
                                        test.factors[d] * trial.factors[d] *
                                          element.component[a][b]);
              }
          }
      }
  }



  /**
   * Unit equations for what is not solved for, and sums over the ranks.
   */
  template <int dim>
  void
  FlowMatrices<dim>::finish(const std::vector<NodeCoupling<dim>> &couplings,
                            const bool with_preconditioner)
  {
    const auto fix = [](const CsrAccess &access, const unsigned int i) {
      access.add(access.row(i), access.column(i), 1.);
    };
    for (const auto node : mesh.owned_nodes())
      {
        const NodeCoupling<dim> &coupling = couplings[node];
        for (unsigned int d = 0; d < dim; ++d)
          if (coupling.master != node || coupling.factors[d] == 0.)
            fix(velocity_access, dim * node + d);
        if (with_preconditioner)
          for (const auto &component : component_matrices)
            if (coupling.master != node ||
                coupling.factors[component->components[0]] == 0.)
              fix(component->access, node);
      }
    if (with_preconditioner)
      for (const auto vertex : mesh.owned_scalars())
        if (pressure_master(vertex) != vertex)
          fix(mass_access, vertex);

    Utilities::MPI::sum(rigid_rhs, mesh.communicator(), rigid_rhs);
    Utilities::MPI::sum(rigid_rigid, mesh.communicator(), rigid_rigid);
    for (unsigned int k = 0; k < n_rigid(); ++k)
      if (!bodies.is_free(k))
        rigid_rigid(k, k) = 1.;
  }



  template class FlowMatrices<2>;
  template class FlowMatrices<3>;
} // namespace Catena

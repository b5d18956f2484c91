#include <catena/flow/flow_matrices.h>
#include <catena/flow/flow_sparsity.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowMatrices<dim>::FlowMatrices(
    const MovingMesh<dim>                &mesh,
    const RigidBodies<dim>               &bodies,
    const std::vector<NodeCoupling<dim>> &couplings)
    : rigid_rigid(n_global_unknowns(mesh, bodies))
    , velocity_rhs(mesh.owned_vectors(), mesh.communicator())
    , pressure_rhs(mesh.owned_scalars(), mesh.communicator())
    , rigid_rhs(n_rigid())
    , vertex_volumes(mesh.owned_scalars(), mesh.communicator())
    , mesh(mesh)
    , bodies(bodies)
    , rigid_owned(n_rigid())
    , rigid_relevant(n_rigid())
  {
    rigid_relevant.add_range(0, n_rigid());
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      rigid_owned.add_range(0, n_rigid());
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
    const FlowSparsity sparsity(mesh, bodies, couplings);
    const MPI_Comm     comm = mesh.communicator();
    velocity.reinit(mesh.owned_vectors(),
                    mesh.owned_vectors(),
                    sparsity.velocities,
                    comm);
    velocity_access =
      CsrAccess(velocity, mesh.owned_vectors(), mesh.relevant_vectors());
    gradient.reinit(mesh.owned_vectors(),
                    mesh.owned_scalars(),
                    sparsity.gradients,
                    comm);
    gradient_access =
      CsrAccess(gradient, mesh.owned_vectors(), mesh.relevant_scalars());
    divergence.reinit(mesh.owned_scalars(),
                      mesh.owned_vectors(),
                      sparsity.divergences,
                      comm);
    divergence_access =
      CsrAccess(divergence, mesh.owned_scalars(), mesh.relevant_vectors());
    pressure_mass.reinit(mesh.owned_scalars(),
                         mesh.owned_scalars(),
                         sparsity.masses,
                         comm);
    mass_access =
      CsrAccess(pressure_mass, mesh.owned_scalars(), mesh.relevant_scalars());
    if (n_rigid() > 0)
      {
        velocity_rigid.reinit(mesh.owned_vectors(),
                              rigid_owned,
                              sparsity.velocity_motions,
                              comm);
        velocity_rigid_access =
          CsrAccess(velocity_rigid, mesh.owned_vectors(), rigid_relevant);
        rigid_velocity_transposed.reinit(mesh.owned_vectors(),
                                         rigid_owned,
                                         sparsity.velocity_motions,
                                         comm);
        rigid_velocity_access = CsrAccess(rigid_velocity_transposed,
                                          mesh.owned_vectors(),
                                          rigid_relevant);
        pressure_rigid.reinit(mesh.owned_scalars(),
                              rigid_owned,
                              sparsity.pressure_motions,
                              comm);
        pressure_rigid_access =
          CsrAccess(pressure_rigid, mesh.owned_scalars(), rigid_relevant);
        velocity_rigid_product = RigidProduct(velocity_rigid);
        rigid_velocity_product = RigidProduct(rigid_velocity_transposed);
        pressure_rigid_product = RigidProduct(pressure_rigid);
      }
    velocity_product   = BlockProduct<dim, dim>(velocity);
    gradient_product   = BlockProduct<dim, 1>(gradient);
    divergence_product = BlockProduct<1, dim>(divergence);
    make_component_matrices(couplings, sparsity.nodes);
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
                  offsets[c].gradient[v][b] =
                    gradient_access.offset(gradient_row,
                                           gradient_access.column(vertex));
              }
          }
      }
  }



  /// Has a component the factors of others wherever both have an unknown?
  template <int dim>
  bool
  FlowMatrices<dim>::share_operator(
    const std::vector<unsigned int>      &components,
    const unsigned int                    component,
    const std::vector<NodeCoupling<dim>> &couplings) const
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
  FlowMatrices<dim>::make_component_matrices(
    const std::vector<NodeCoupling<dim>> &couplings,
    const DynamicSparsityPattern         &nodes)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        bool is_new = true;
        for (const auto &group : component_matrices)
          if (is_new && share_operator(group->components, d, couplings))
            {
              group->components.push_back(d);
              is_new = false;
            }
        if (!is_new)
          continue;
        auto group = std::make_unique<ComponentMatrix>();
        group->components.push_back(d);
        group->matrix.reinit(mesh.owned_nodes(),
                             mesh.owned_nodes(),
                             nodes,
                             mesh.communicator());
        group->access =
          CsrAccess(group->matrix, mesh.owned_nodes(), mesh.relevant_nodes());
        component_matrices.push_back(std::move(group));
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

    CellValues<dim> standard_values,
      precise_values(QWitherdenVincentSimplex<dim>(3));
    CellValues<dim> &values = body_force ? precise_values : standard_values;
    std::vector<StressCoefficients<dim>> coefficients;
    FlowElement<dim>                     element;
    for (unsigned int c = 0; c < mesh.cells().size(); ++c)
      {
        const auto &cell      = mesh.cells()[c];
        const auto  positions = mesh.cell_positions(cell, mesh.positions());
        values.reinit(positions, cell.curved);
        stress.evaluate(cell, values, coefficients);

        element.reset(cell, couplings);
        element.integrate(values.points(), coefficients, imposed_gradient);
        if (body_force)
          for (const auto &point : values.points())
            element.add_body_force(point, positions, *body_force);
        if (element.touches_particle)
          element.condense_known_velocities();

        add_velocity_block(element, offsets[c]);
        add_pressure_blocks(element, offsets[c]);
        add_right_hand_side(element);
        if (element.touches_particle)
          add_rigid_blocks(element);
        if (mesh.scene().pressure_driven())
          add_pressure_drop(element);
        if (with_preconditioner)
          add_preconditioner(element, offsets[c]);
      }
    if (mesh.scene().pressure_driven())
      add_pressure_drop_on_particles();
    finish(couplings, with_preconditioner);
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_velocity_block(const FlowElement<dim> &element,
                                        const Offsets          &offset)
  {
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
      {
        const NodeCoupling<dim> &test = *element.couplings[a];
        const int                row  = velocity_access.row(dim * test.master);
        if (!test.has_unknown() || row == CsrAccess::absent)
          continue;
        for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
          {
            if (!element.couplings[b]->has_unknown())
              continue;
            const auto &trial = element.couplings[b]->factors;
            for (unsigned int i = 0; i < dim; ++i)
              {
                double *entries =
                  velocity_access.values(row + i) + offset.velocity[a][b];
                for (unsigned int j = 0; j < dim; ++j)
                  entries[j] +=
                    test.factors[i] * element.velocity[i][j][a][b] * trial[j];
              }
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_pressure_blocks(const FlowElement<dim> &element,
                                         const Offsets          &offset)
  {
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const unsigned int master = pressure_master(element.cell->vertices[v]);
        const int          row    = divergence_access.row(master);
        for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
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
                gradient_access.values(gradient_row +
                                       j)[offset.gradient[v][b]] +=
                  value[j] * node.factors[j];
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_right_hand_side(const FlowElement<dim> &element)
  {
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
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
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const unsigned int master = pressure_master(element.cell->vertices[v]);
        if (!mesh.owned_scalars().is_element(master))
          continue;
        vertex_volumes(master) += element.volume[v];
        if (element.touches_particle)
          for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              pressure_rhs(master) -=
                element.divergence[v][b][j] * element.couplings[b]->known[j];
      }
  }



  /**
   * The element's matrices times the motions of its nodes are summed up by
   * rigid-body unknown first: looking up their places takes longer.
   */
  template <int dim>
  void
  FlowMatrices<dim>::add_rigid_blocks(const FlowElement<dim> &element)
  {
    constexpr unsigned int n_nodes = FlowElement<dim>::n_nodes;

    using NodeVectors = std::array<Tensor<1, dim>, n_nodes>;
    struct Columns
    {
      /// K m and K^T m for the nodes' motion m of a unit of the unknown
      NodeVectors forward = {}, transposed = {};
      std::array<double, FlowElement<dim>::n_vertices> divergence = {};
    };
    std::map<unsigned int, Columns> unknowns;
    for (unsigned int b = 0; b < n_nodes; ++b)
      for (unsigned int j = 0; j < dim; ++j)
        for (const auto &motion : element.couplings[b]->motions[j])
          {
            Columns &columns = unknowns[motion.first];
            for (unsigned int a = 0; a < n_nodes; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                {
                  columns.forward[a][i] +=
                    element.velocity[i][j][a][b] * motion.second;
                  columns.transposed[a][i] +=
                    element.velocity[j][i][b][a] * motion.second;
                }
            for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
              columns.divergence[v] +=
                element.divergence[v][b][j] * motion.second;
          }

    for (const auto &unknown : unknowns)
      {
        const unsigned int k                 = unknown.first;
        const Columns     &columns           = unknown.second;
        const int          column            = velocity_rigid_access.column(k);
        const int          column_transposed = rigid_velocity_access.column(k);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const NodeCoupling<dim> &node = *element.couplings[a];
            if (node.rigid && element.cell->owned)
              for (unsigned int i = 0; i < dim; ++i)
                for (const auto &test : node.motions[i])
                  rigid_rigid(test.first, k) +=
                    test.second * columns.forward[a][i];
            const int row = velocity_rigid_access.row(dim * node.master);
            if (!node.has_unknown() || row == CsrAccess::absent)
              continue;
            for (unsigned int i = 0; i < dim; ++i)
              {
                velocity_rigid_access.add(
                  row + i, column, node.factors[i] * columns.forward[a][i]);
                rigid_velocity_access.add(row + i,
                                          column_transposed,
                                          node.factors[i] *
                                            columns.transposed[a][i]);
              }
          }
        for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
          {
            const int row = pressure_rigid_access.row(
              pressure_master(element.cell->vertices[v]));
            if (row != CsrAccess::absent)
              pressure_rigid_access.add(row,
                                        pressure_rigid_access.column(k),
                                        columns.divergence[v]);
          }
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_pressure_drop(const FlowElement<dim> &element)
  {
    const unsigned int drop              = bodies.n_unknowns();
    const int          column            = velocity_rigid_access.column(drop);
    const int          column_transposed = rigid_velocity_access.column(drop);
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
      {
        const NodeCoupling<dim> &node = *element.couplings[a];
        const double value = -element.node_volume[a] / mesh.scene().length;
        const int    row   = velocity_rigid_access.row(dim * node.master);
        if (node.factors[0] != 0. && row != CsrAccess::absent)
          {
            velocity_rigid_access.add(row, column, node.factors[0] * value);
            rigid_velocity_access.add(row,
                                      column_transposed,
                                      node.factors[0] * value);
          }
        if (node.rigid && element.cell->owned)
          {
            rigid_rhs[drop] -= value * node.known[0];
            for (const auto &motion : node.motions[0])
              {
                rigid_rigid(motion.first, drop) += motion.second * value;
                rigid_rigid(drop, motion.first) += motion.second * value;
              }
          }
      }
  }



  /**
   * The part of the pressure drop's row and column inside the particles, and
   * the flow rate.
   */
  template <int dim>
  void
  FlowMatrices<dim>::add_pressure_drop_on_particles()
  {
    // each rank adds its part, all of them are summed later
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) != 0)
      return;
    const unsigned int drop = bodies.n_unknowns();
    for (unsigned int k = 0; k < drop; ++k)
      {
        const double value = -bodies.meshed_share(k) *
                             bodies.displaced_volume(k) / mesh.scene().length;
        if (bodies.is_free(k))
          {
            rigid_rigid(k, drop) += value;
            rigid_rigid(drop, k) += value;
          }
      }
    rigid_rhs[drop] -= mesh.scene().section();
  }



  template <int dim>
  void
  FlowMatrices<dim>::add_preconditioner(const FlowElement<dim> &element,
                                        const Offsets          &offset)
  {
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const int row =
          mass_access.row(pressure_master(element.cell->vertices[v]));
        if (row == CsrAccess::absent)
          continue;
        for (unsigned int w = 0; w < FlowElement<dim>::n_vertices; ++w)
          mass_access.add(row,
                          mass_access.column(
                            pressure_master(element.cell->vertices[w])),
                          element.mass[v][w]);
      }
    for (const auto &component : component_matrices)
      {
        std::array<double, FlowElement<dim>::n_nodes> factors;
        for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
          factors[a] =
            element.couplings[a]->shared_factor(component->components);
        for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
          {
            const int row = component->access.row(element.couplings[a]->master);
            if (factors[a] == 0. || row == CsrAccess::absent)
              continue;
            // a component's matrix has an entry where the velocity's has a
            // block
            double *entries = component->access.values(row);
            for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
              if (factors[b] != 0.)
                entries[offset.velocity[a][b] / dim] +=
                  factors[a] * factors[b] * element.component[a][b];
          }
      }
  }



  /**
   * Unit equations for what is not solved for, products, and sums over the
   * ranks.
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
                coupling.shared_factor(component->components) == 0.)
              fix(component->access, node);
      }
    if (with_preconditioner)
      for (const auto vertex : mesh.owned_scalars())
        if (pressure_master(vertex) != vertex)
          fix(mass_access, vertex);
    velocity_product.update();
    gradient_product.update();
    divergence_product.update();

    // nothing moves, and a matrix without entries has no sum
    if (bodies.n_unknowns() == 0)
      return;
    Utilities::MPI::sum(rigid_rhs, mesh.communicator(), rigid_rhs);
    Utilities::MPI::sum(rigid_rigid, mesh.communicator(), rigid_rigid);
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      if (!bodies.is_free(k))
        rigid_rigid(k, k) = 1.;
  }



  template class FlowMatrices<2>;
  template class FlowMatrices<3>;
} // namespace Catena

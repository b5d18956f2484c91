#include <catena/flow/flow_assembly.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowAssembly<dim>::FlowAssembly(
    const MovingMesh<dim>                &mesh,
    const RigidBodies<dim>               &bodies,
    const std::vector<NodeCoupling<dim>> &couplings,
    FlowMatrices<dim>                    &matrices)
    : mesh(mesh)
    , bodies(bodies)
    , couplings(couplings)
    , matrices(matrices)
  {}



  template <int dim>
  void
  FlowAssembly<dim>::assemble(const StressModel<dim> &stress,
                              const Tensor<2, dim>   &imposed_gradient,
                              const bool              with_preconditioner,
                              const Function<dim>    *body_force)
  {
    matrices.clear(with_preconditioner);

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

        add_velocity_block(element, matrices.offsets[c]);
        add_pressure_blocks(element, matrices.offsets[c]);
        add_right_hand_side(element);
        if (element.touches_particle)
          add_rigid_blocks(element);
        if (mesh.scene().pressure_driven())
          add_pressure_drop(element);
        if (with_preconditioner)
          add_preconditioner(element, matrices.offsets[c]);
      }
    if (mesh.scene().pressure_driven())
      add_pressure_drop_on_particles();
    finish(with_preconditioner);
  }



  template <int dim>
  void
  FlowAssembly<dim>::add_velocity_block(const FlowElement<dim> &element,
                                        const Offsets          &offset)
  {
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
      {
        const NodeCoupling<dim> &test = *element.couplings[a];
        const unsigned int row = matrices.velocity.pattern().row(test.master);
        if (!test.has_unknown() || row == BlockPattern::absent)
          continue;
        for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
          {
            if (!element.couplings[b]->has_unknown())
              continue;
            const auto &trial = element.couplings[b]->factors;
            double *block = matrices.velocity.block(row, offset.velocity[a][b]);
            for (unsigned int j = 0; j < dim; ++j)
              for (unsigned int i = 0; i < dim; ++i)
                *block++ +=
                  test.factors[i] * element.velocity[i][j][a][b] * trial[j];
          }
      }
  }



  template <int dim>
  void
  FlowAssembly<dim>::add_pressure_blocks(const FlowElement<dim> &element,
                                         const Offsets          &offset)
  {
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const unsigned int master =
          mesh.vertex_master(element.cell->vertices[v]);
        const unsigned int row = matrices.divergence.pattern().row(master);
        for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
          {
            const NodeCoupling<dim> &node = *element.couplings[b];
            if (!node.has_unknown())
              continue;
            const Tensor<1, dim> value  = element.divergence[v][b];
            const auto           add_to = [&](double *block) {
              for (unsigned int j = 0; j < dim; ++j)
                block[j] += value[j] * node.factors[j];
            };
            if (row != BlockPattern::absent)
              add_to(matrices.divergence.block(row, offset.divergence[v][b]));
            const unsigned int gradient_row =
              matrices.gradient.pattern().row(node.master);
            if (gradient_row != BlockPattern::absent)
              add_to(
                matrices.gradient.block(gradient_row, offset.gradient[v][b]));
          }
      }
  }



  template <int dim>
  void
  FlowAssembly<dim>::add_right_hand_side(const FlowElement<dim> &element)
  {
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
      {
        const NodeCoupling<dim> &node = *element.couplings[a];
        if (node.has_unknown() &&
            mesh.owned_vectors().is_element(dim * node.master))
          for (unsigned int i = 0; i < dim; ++i)
            matrices.velocity_rhs(dim * node.master + i) +=
              node.factors[i] * element.rhs[a][i];
        if (node.rigid && element.cell->owned)
          for (unsigned int i = 0; i < dim; ++i)
            for (const auto &motion : node.motions[i])
              matrices.rigid_rhs[motion.first] +=
                motion.second * element.rhs[a][i];
      }
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const unsigned int master =
          mesh.vertex_master(element.cell->vertices[v]);
        if (!mesh.owned_scalars().is_element(master))
          continue;
        matrices.vertex_volumes(master) += element.volume[v];
        if (element.touches_particle)
          for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              matrices.pressure_rhs(master) -=
                element.divergence[v][b][j] * element.couplings[b]->known[j];
      }
  }



  /**
   * The element's matrices times the motions of its nodes are summed up by
   * rigid-body unknown first: looking up their places takes longer.
   */
  template <int dim>
  void
  FlowAssembly<dim>::add_rigid_blocks(const FlowElement<dim> &element)
  {
    constexpr unsigned int n_nodes = FlowElement<dim>::n_nodes;

    struct Columns
    {
      /// K m and K^T m for the nodes' motion m of a unit of the unknown
      std::array<std::array<double, n_nodes>, dim>     forward = {};
      NodeVectors<dim>                                 transposed;
      std::array<double, FlowElement<dim>::n_vertices> divergence = {};
    };
    std::map<unsigned int, Columns> unknowns;
    for (unsigned int b = 0; b < n_nodes; ++b)
      for (unsigned int j = 0; j < dim; ++j)
        for (const auto &motion : element.couplings[b]->motions[j])
          {
            Columns &columns = unknowns[motion.first];
            for (unsigned int i = 0; i < dim; ++i)
              {
                for (unsigned int a = 0; a < n_nodes; ++a)
                  columns.forward[i][a] +=
                    element.velocity[i][j][a][b] * motion.second;
                columns.transposed.components[i].add(motion.second,
                                                     element.velocity[j][i][b]);
              }
            for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
              columns.divergence[v] +=
                element.divergence[v].components[j][b] * motion.second;
          }

    for (const auto &unknown : unknowns)
      {
        const unsigned int k        = unknown.first;
        const Columns     &columns  = unknown.second;
        const int          column   = matrices.velocity_rigid_access.column(k);
        const int column_transposed = matrices.rigid_velocity_access.column(k);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const NodeCoupling<dim> &node = *element.couplings[a];
            if (node.rigid && element.cell->owned)
              for (unsigned int i = 0; i < dim; ++i)
                for (const auto &test : node.motions[i])
                  matrices.rigid_rigid(test.first, k) +=
                    test.second * columns.forward[i][a];
            const int row =
              matrices.velocity_rigid_access.row(dim * node.master);
            if (!node.has_unknown() || row == CsrAccess::absent)
              continue;
            for (unsigned int i = 0; i < dim; ++i)
              {
                matrices.velocity_rigid_access.add(
                  row + i, column, node.factors[i] * columns.forward[i][a]);
                matrices.rigid_velocity_access.add(
                  row + i,
                  column_transposed,
                  node.factors[i] * columns.transposed.components[i][a]);
              }
          }
        for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
          {
            const int row = matrices.pressure_rigid_access.row(
              mesh.vertex_master(element.cell->vertices[v]));
            if (row != CsrAccess::absent)
              matrices.pressure_rigid_access.add(
                row,
                matrices.pressure_rigid_access.column(k),
                columns.divergence[v]);
          }
      }
  }



  template <int dim>
  void
  FlowAssembly<dim>::add_pressure_drop(const FlowElement<dim> &element)
  {
    const unsigned int drop     = bodies.n_unknowns();
    const int          column   = matrices.velocity_rigid_access.column(drop);
    const int column_transposed = matrices.rigid_velocity_access.column(drop);
    for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
      {
        const NodeCoupling<dim> &node = *element.couplings[a];
        const double value = -element.node_volume[a] / mesh.scene().length;
        const int row = matrices.velocity_rigid_access.row(dim * node.master);
        if (node.factors[0] != 0. && row != CsrAccess::absent)
          {
            matrices.velocity_rigid_access.add(row,
                                               column,
                                               node.factors[0] * value);
            matrices.rigid_velocity_access.add(row,
                                               column_transposed,
                                               node.factors[0] * value);
          }
        if (node.rigid && element.cell->owned)
          {
            matrices.rigid_rhs[drop] -= value * node.known[0];
            for (const auto &motion : node.motions[0])
              {
                matrices.rigid_rigid(motion.first, drop) +=
                  motion.second * value;
                matrices.rigid_rigid(drop, motion.first) +=
                  motion.second * value;
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
  FlowAssembly<dim>::add_pressure_drop_on_particles()
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
            matrices.rigid_rigid(k, drop) += value;
            matrices.rigid_rigid(drop, k) += value;
          }
      }
    matrices.rigid_rhs[drop] -= mesh.scene().section();
  }



  template <int dim>
  void
  FlowAssembly<dim>::add_preconditioner(const FlowElement<dim> &element,
                                        const Offsets          &offset)
  {
    for (unsigned int v = 0; v < FlowElement<dim>::n_vertices; ++v)
      {
        const int row = matrices.mass_access.row(
          mesh.vertex_master(element.cell->vertices[v]));
        if (row == CsrAccess::absent)
          continue;
        for (unsigned int w = 0; w < FlowElement<dim>::n_vertices; ++w)
          matrices.mass_access.add(row,
                                   matrices.mass_access.column(
                                     mesh.vertex_master(
                                       element.cell->vertices[w])),
                                   element.mass[v][w]);
      }
    for (auto &component : matrices.component_matrices)
      {
        std::array<double, FlowElement<dim>::n_nodes> factors;
        for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
          factors[a] =
            element.couplings[a]->shared_factor(component.components);
        for (unsigned int a = 0; a < FlowElement<dim>::n_nodes; ++a)
          {
            const unsigned int row =
              component.matrix.pattern().row(element.couplings[a]->master);
            if (factors[a] == 0. || row == BlockPattern::absent)
              continue;
            for (unsigned int b = 0; b < FlowElement<dim>::n_nodes; ++b)
              if (factors[b] != 0.)
                *component.matrix.block(row, offset.velocity[a][b]) +=
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
  FlowAssembly<dim>::finish(const bool with_preconditioner)
  {
    for (const auto node : mesh.owned_nodes())
      {
        const NodeCoupling<dim> &coupling       = couplings[node];
        const auto               diagonal_block = [node](auto &matrix) {
          const unsigned int row = matrix.pattern().row(node);
          return matrix.block(row, matrix.pattern().offset(row, node));
        };
        for (unsigned int d = 0; d < dim; ++d)
          if (coupling.master != node || coupling.factors[d] == 0.)
            diagonal_block(matrices.velocity)[(dim + 1) * d] += 1.;
        if (with_preconditioner)
          for (auto &component : matrices.component_matrices)
            if (coupling.master != node ||
                coupling.shared_factor(component.components) == 0.)
              *diagonal_block(component.matrix) += 1.;
      }
    const CsrAccess &mass = matrices.mass_access;
    if (with_preconditioner)
      for (const auto vertex : mesh.owned_scalars())
        if (mesh.vertex_master(vertex) != vertex)
          mass.add(mass.row(vertex), mass.column(vertex), 1.);
    matrices.update_single_precision();

    // nothing moves, and a matrix without entries has no sum
    if (bodies.n_unknowns() == 0)
      return;
    Utilities::MPI::sum(matrices.rigid_rhs,
                        mesh.communicator(),
                        matrices.rigid_rhs);
    Utilities::MPI::sum(matrices.rigid_rigid,
                        mesh.communicator(),
                        matrices.rigid_rigid);
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      if (!bodies.is_free(k))
        matrices.rigid_rigid(k, k) = 1.;
  }



  template class FlowAssembly<2>;
  template class FlowAssembly<3>;
} // namespace Catena

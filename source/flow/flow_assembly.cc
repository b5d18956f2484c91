#include <catena/flow/flow_assembly.h>
#include <catena/flow/flow_element.h>
#include <catena/mesh/cell_fields.h>

#include <deal.II/base/quadrature_lib.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// int f . v of the cells of this rank.
    template <int dim>
    void
    add_body_force(const Function<dim>   &force,
                   const FlowSystem<dim> &system,
                   double                *sums)
    {
      const MovingMesh<dim> &mesh = system.mesh;
      CellValues<dim>        values(QWitherdenVincentSimplex<dim>(3));
      for (const auto &cell : mesh.cells())
        {
          if (!cell.owned)
            continue;
          const auto positions = mesh.cell_positions(cell, mesh.positions());
          values.reinit(positions, cell.curved);
          for (const auto &point : values.points())
            {
              const Point<dim> x = position_at<dim>(point, positions);
              for (unsigned int i = 0; i < dim; ++i)
                {
                  const double f = point.JxW * force.value(x, i);
                  for (unsigned int a = 0; a < mesh.n_nodes; ++a)
                    sums[n_node_numbers *
                           system.nodes().global_to_local(cell.nodes[a]) +
                         i] += f * point.quadratic[a];
                }
            }
        }
    }
  } // namespace



  template <int dim>
  void
  assemble_flow(const StressModel<dim>      &stress,
                const Tensor<2, dim>        &imposed_gradient,
                FlowSystem<dim>             &system,
                PreconditionerMatrices<dim> *preconditioner,
                const Function<dim>         *body_force)
  {
    const MovingMesh<dim> &mesh   = system.mesh;
    const bool             driven = mesh.scene().pressure_driven();
    auto                   forces = system.node_field();
    VectorType             volumes(mesh.owned_scalars(),
                       mesh.relevant_scalars(),
                       mesh.communicator());
    system.node_volumes.assign(driven ? system.nodes().locally_owned_size() +
                                          system.nodes().n_ghost_indices() :
                                        0,
                               0.);
    system.cells.set_form(stress.has_scalar_viscosity(), stress.has_tangent());
    if (preconditioner)
      preconditioner->clear();

    CellValues<dim>                      values;
    std::vector<StressCoefficients<dim>> coefficients;
    for (unsigned int c = 0; c < mesh.cells().size(); ++c)
      {
        const auto &cell = mesh.cells()[c];
        if (!cell.owned && !preconditioner)
          continue;
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        stress.evaluate(cell, values, coefficients);
        if (preconditioner)
          preconditioner->add(c, {values.points(), coefficients});
        if (!cell.owned)
          continue;

        system.cells.set(c, values.points(), coefficients);
        const FlowElement<dim> element(values.points(),
                                       coefficients,
                                       imposed_gradient);
        for (unsigned int a = 0; a < mesh.n_nodes; ++a)
          {
            const unsigned int node =
              system.nodes().global_to_local(cell.nodes[a]);
            for (unsigned int d = 0; d < dim; ++d)
              forces.local_element(n_node_numbers * node + d) +=
                element.forces.components[d][a];
            if (driven)
              system.node_volumes[node] += element.node_volume[a];
          }
        for (unsigned int v = 0; v < mesh.n_vertices; ++v)
          volumes(mesh.vertex_master(cell.vertices[v])) += element.volume[v];
      }
    if (body_force)
      add_body_force(*body_force, system, forces.begin());
    if (preconditioner)
      preconditioner->finish();

    volumes.compress(VectorOperation::add);
    system.vertex_volumes.copy_locally_owned_data_from(volumes);
    system.set_right_hand_side(forces);
  }



  template void
  assemble_flow(const StressModel<2> &,
                const Tensor<2, 2> &,
                FlowSystem<2> &,
                PreconditionerMatrices<2> *,
                const Function<2> *);
  template void
  assemble_flow(const StressModel<3> &,
                const Tensor<2, 3> &,
                FlowSystem<3> &,
                PreconditionerMatrices<3> *,
                const Function<3> *);
} // namespace Catena

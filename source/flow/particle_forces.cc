#include <catena/flow/particle_forces.h>
#include <catena/mesh/cell_fields.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  std::vector<double>
  particle_forces(const MovingMesh<dim>    &mesh,
                  const RigidBodies<dim>   &bodies,
                  const Configuration<dim> &configuration,
                  const StressModel<dim>   &stress,
                  const FlowFields<dim>    &fields)
  {
    constexpr unsigned int none = MovingMesh<dim>::no_particle;

    const double pressure_gradient = fields.pressure_drop / mesh.scene().length;
    std::vector<double>                  forces(bodies.n_unknowns(), 0.);
    CellValues<dim>                      values;
    std::vector<StressCoefficients<dim>> coefficients;
    for (const auto &cell : mesh.cells())
      {
        bool touches = false;
        for (const unsigned int node : cell.nodes)
          touches |= mesh.particle(node) != none;
        if (!cell.owned || !touches)
          continue;
        const auto positions = mesh.cell_positions(cell, mesh.positions());
        values.reinit(positions, cell.curved);
        stress.evaluate(cell, values, coefficients);
        const auto u = node_vectors<dim>(cell, fields.velocity);
        for (unsigned int q = 0; q < coefficients.size(); ++q)
          {
            const auto &point    = values.points()[q];
            double      pressure = 0.;
            for (unsigned int v = 0; v < mesh.n_vertices; ++v)
              pressure += fields.pressure(cell.vertices[v]) * point.linear[v];

            const SymmetricTensor<2, dim> total =
              coefficients[q].stress(gradient_at<dim>(point, u)) -
              pressure * unit_symmetric_tensor<dim>();
            for (unsigned int a = 0; a < mesh.n_nodes; ++a)
              {
                const unsigned int node = cell.nodes[a];
                if (mesh.particle(node) == none)
                  continue;
                Tensor<1, dim> nodal = total * point.quadratic_gradient[a];
                nodal[0] -= pressure_gradient * point.quadratic[a];
                const Tensor<1, dim> reaction =
                  mesh.particle_image(node).turn(point.JxW * nodal);
                const Tensor<1, dim> arm =
                  mesh.arm(node, positions[a], configuration.centres);
                const auto range = bodies.range(mesh.particle(node));
                for (unsigned int k = range.first; k < range.second; ++k)
                  forces[k] += bodies.unit_velocity(k, arm) * reaction;
              }
          }
      }
    Utilities::MPI::sum(forces, mesh.communicator(), forces);
    for (unsigned int k = 0; k < forces.size(); ++k)
      forces[k] = forces[k] / bodies.meshed_share(k) -
                  pressure_gradient * bodies.displaced_volume(k);
    return forces;
  }



  template std::vector<double>
  particle_forces<2>(const MovingMesh<2> &,
                     const RigidBodies<2> &,
                     const Configuration<2> &,
                     const StressModel<2> &,
                     const FlowFields<2> &);
  template std::vector<double>
  particle_forces<3>(const MovingMesh<3> &,
                     const RigidBodies<3> &,
                     const Configuration<3> &,
                     const StressModel<3> &,
                     const FlowFields<3> &);
} // namespace Catena

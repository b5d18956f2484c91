#include <catena/flow/velocity_constraints.h>
#include <catena/mesh/cell_fields.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  std::vector<RigidMotion<dim>>
  reference_motions(const Scene<dim>         &scene,
                    const Configuration<dim> &configuration,
                    const bool                held_in_place)
  {
    std::vector<RigidMotion<dim>> motions(configuration.centres.size());
    for (unsigned int i = 0; i < motions.size(); ++i)
      {
        if (scene.particles[i].fixed)
          continue;
        if (!held_in_place)
          motions[i].velocity =
            configuration.shear_rate *
            scene.imposed_velocity(configuration.centres[i]);
        const Tensor<2, dim> L =
          configuration.shear_rate * scene.imposed_gradient();
        motions[i].angular_velocity[2] = (L[1][0] - L[0][1]) / 2.;
      }
    return motions;
  }



  template <int dim>
  AffineConstraints<double>
  velocity_constraints(const MovingMesh<dim>    &mesh,
                       const RigidBodies<dim>   &bodies,
                       const Configuration<dim> &configuration,
                       const bool                held_in_place)
  {
    const Scene<dim>                   &scene          = mesh.scene();
    const NodeIdentification           &identification = mesh.identification();
    const std::vector<RigidMotion<dim>> references =
      reference_motions(scene, configuration, held_in_place);
    const types::global_dof_index n_velocity = mesh.vector_dofs().n_dofs();

    IndexSet lines(n_velocity + bodies.n_unknowns());
    lines.add_indices(mesh.relevant_vectors());
    lines.add_range(n_velocity, n_velocity + bodies.n_unknowns());
    AffineConstraints<double> constraints(lines);

    for (const auto node : mesh.relevant_nodes())
      {
        const unsigned int particle = mesh.particle(node);
        const Point<dim>   x = node_position<dim>(mesh.positions(), node);

        if (particle != MovingMesh<dim>::no_particle)
          {
            const Image<dim>    &image = mesh.particle_image(node);
            const Tensor<1, dim> arm = mesh.arm(node, x, configuration.centres);
            const Tensor<1, dim> known =
              image.turn(references[particle].at(arm)) -
              configuration.shear_rate * scene.imposed_velocity(x);
            for (unsigned int d = 0; d < dim; ++d)
              {
                constraints.add_line(dim * node + d);
                constraints.set_inhomogeneity(dim * node + d, known[d]);
              }
            const auto range = bodies.range(particle);
            for (unsigned int k = range.first; k < range.second; ++k)
              if (bodies.is_free(k))
                {
                  const Tensor<1, dim> u =
                    image.turn(bodies.unit_velocity(k, arm));
                  for (unsigned int d = 0; d < dim; ++d)
                    if (u[d] != 0.)
                      constraints.add_entry(dim * node + d,
                                            n_velocity + k,
                                            u[d]);
                }
            continue;
          }

        const unsigned int master = identification.master(node);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double factor = identification.vector_factor(node, d);
            const bool   fixed  = mesh.on_wall(node) || factor == 0. ||
                               (d == 2 && mesh.on_mirror(node));
            if (fixed || master != node)
              constraints.add_line(dim * node + d);
            if (!fixed && master != node)
              constraints.add_entry(dim * node + d, dim * master + d, factor);
          }
      }
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      if (!bodies.is_free(k))
        constraints.add_line(n_velocity + k);
    constraints.close();
    return constraints;
  }



#define INSTANTIATE(dim)                                         \
  template std::vector<RigidMotion<dim>> reference_motions<dim>( \
    const Scene<dim> &, const Configuration<dim> &, const bool); \
  template AffineConstraints<double> velocity_constraints<dim>(  \
    const MovingMesh<dim> &,                                     \
    const RigidBodies<dim> &,                                    \
    const Configuration<dim> &,                                  \
    const bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Catena

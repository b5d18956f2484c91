#include <catena/flow/flow_fields.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/mesh/cell_fields.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowFields<dim>
  combination(const double           a,
              const FlowFields<dim> &x,
              const double           b,
              const FlowFields<dim> &y)
  {
    FlowFields<dim> result = x;
    result.velocity.update_ghost_values();
    result.pressure.update_ghost_values();
    if (b == 0.)
      return result;

    result.velocity.sadd(a, b, y.velocity);
    result.velocity.update_ghost_values();
    result.pressure.sadd(a, b, y.pressure);
    result.pressure.update_ghost_values();
    result.pressure_drop = a * x.pressure_drop + b * y.pressure_drop;
    for (unsigned int i = 0; i < x.motions.size(); ++i)
      {
        RigidMotion<dim>       &motion = result.motions[i];
        const RigidMotion<dim> &other  = y.motions[i];
        motion.velocity = a * motion.velocity + b * other.velocity;
        motion.angular_velocity =
          a * motion.angular_velocity + b * other.angular_velocity;
      }
    if (x.contact_forces.size() == y.contact_forces.size())
      for (unsigned int c = 0; c < x.contact_forces.size(); ++c)
        result.contact_forces[c] =
          a * x.contact_forces[c] + b * y.contact_forces[c];
    return result;
  }



  template <int dim>
  FlowFields<dim>
  imposed_flow(const MovingMesh<dim>    &mesh,
               const Configuration<dim> &configuration,
               const bool                held_in_place)
  {
    FlowFields<dim> flow;
    flow.velocity = mesh.vector_field();
    for (const auto node : mesh.owned_nodes())
      {
        const Tensor<1, dim> imposed =
          configuration.shear_rate *
          Scene<dim>::imposed_velocity(
            node_position<dim>(mesh.positions(), node));
        for (unsigned int d = 0; d < dim; ++d)
          flow.velocity(dim * node + d) = imposed[d];
      }
    flow.velocity.update_ghost_values();
    flow.pressure = mesh.scalar_field();
    flow.motions =
      reference_motions<dim>(mesh.scene(), configuration, held_in_place);
    return flow;
  }



  template FlowFields<2>
  combination(const double,
              const FlowFields<2> &,
              const double,
              const FlowFields<2> &);
  template FlowFields<3>
  combination(const double,
              const FlowFields<3> &,
              const double,
              const FlowFields<3> &);
  template FlowFields<2>
  imposed_flow(const MovingMesh<2> &, const Configuration<2> &, const bool);
  template FlowFields<3>
  imposed_flow(const MovingMesh<3> &, const Configuration<3> &, const bool);
} // namespace Catena

#ifndef catena_flow_particle_forces_h
#define catena_flow_particle_forces_h

#include <catena/flow/flow_fields.h>
#include <catena/flow/stress_model.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>

#include <vector>

namespace Catena
{
  /**
   * Force [eta0 gamma a^2] and torque [eta0 gamma a^3] that must act on each
   * whole particle from outside to balance the fluid, by rigid-body unknown:
   * the sums of the nodal reactions
   *
   *   int (sigma : grad(phi_i e_d) - P/L phi_i e_x.e_d) over the fluid
   *
   * (less P/L times the volume of the particle along x, in a scene where the
   * pressure falls by P along a period L, see FlowSystem)
   * at the nodes on its surface, each times the velocity of the node for a
   * unit motion, and divided by the meshed share. Zero, to the tolerance of
   * the solver, for a free particle without contacts.
   */
  template <int dim>
  std::vector<double>
  particle_forces(const MovingMesh<dim>    &mesh,
                  const RigidBodies<dim>   &bodies,
                  const Configuration<dim> &configuration,
                  const StressModel<dim>   &stress,
                  const FlowFields<dim>    &fields);
} // namespace Catena

#endif

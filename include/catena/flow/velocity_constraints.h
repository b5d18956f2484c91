#ifndef catena_flow_velocity_constraints_h
#define catena_flow_velocity_constraints_h

#include <catena/mesh/moving_mesh.h>
#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>

#include <deal.II/lac/affine_constraints.h>

namespace Catena
{
  /**
   * The motion against which that of a particle is counted: the imposed shear
   * flow and its rotation at the centre; only the rotation while particles are
   * held; for a fixed particle rest and no rotation.
   */
  template <int dim>
  std::vector<RigidMotion<dim>>
  reference_motions(const Scene<dim>         &scene,
                    const Configuration<dim> &configuration,
                    const bool                held_in_place);

  /**
   * Constraints of the disturbance velocity u' = u - u_imposed on a mesh
   * whose particles are at @p configuration. Unknowns are numbered: velocity
   * degrees of freedom first, then rigid-body unknown k as n_velocity + k.
   *
   * - walls: u' = 0; mirror planes: u'_z = 0;
   * - identified planes: the value at the master node, turned;
   * - particles (collocation at the nodes, Jaensson et al. 2016, section 3):
   *   u' = U + omega x (x - X) - u_imposed(x), with U and omega counted
   *   against reference_motions().
   */
  template <int dim>
  dealii::AffineConstraints<double>
  velocity_constraints(const MovingMesh<dim>    &mesh,
                       const RigidBodies<dim>   &bodies,
                       const Configuration<dim> &configuration,
                       const bool                held_in_place);
} // namespace Catena

#endif

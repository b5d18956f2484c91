#ifndef catena_flow_flow_sparsity_h
#define catena_flow_flow_sparsity_h

#include <catena/flow/node_couplings.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/particles/rigid_bodies.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <vector>

namespace Catena
{
  /**
   * Sparsity patterns of the blocks of FlowMatrices. The velocity pattern is
   * that of the nodes with all components coupled, so that the rows of a
   * node's components have the same columns, and the columns of a node lie
   * side by side.
   */
  struct FlowSparsity
  {
    template <int dim>
    FlowSparsity(const MovingMesh<dim>                &mesh,
                 const RigidBodies<dim>               &bodies,
                 const std::vector<NodeCoupling<dim>> &couplings);

    dealii::DynamicSparsityPattern nodes, velocities, gradients, divergences,
      masses, velocity_motions, pressure_motions;
  };



  /**
   * Number of the unknowns r of FlowMatrices: the rigid-body unknowns, and the
   * pressure drop of a pressure-driven scene.
   */
  template <int dim>
  unsigned int
  n_global_unknowns(const MovingMesh<dim>  &mesh,
                    const RigidBodies<dim> &bodies);
} // namespace Catena

#endif

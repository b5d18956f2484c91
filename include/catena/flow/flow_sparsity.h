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
   * Which nodes are coupled by A, B^T and B of FlowMatrices, and the sparsity
   * patterns of its other blocks.
   */
  struct FlowSparsity
  {
    template <int dim>
    FlowSparsity(const MovingMesh<dim>                &mesh,
                 const RigidBodies<dim>               &bodies,
                 const std::vector<NodeCoupling<dim>> &couplings);

    dealii::DynamicSparsityPattern nodes, gradients, divergences, masses,
      velocity_motions, pressure_motions;
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

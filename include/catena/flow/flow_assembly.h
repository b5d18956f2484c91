#ifndef catena_flow_flow_assembly_h
#define catena_flow_flow_assembly_h

#include <catena/flow/flow_element.h>
#include <catena/flow/flow_matrices.h>
#include <catena/flow/stress_model.h>

#include <deal.II/base/function.h>

namespace Catena
{
  /**
   * Integrates the equations of FlowMatrices over the cells. Rows are assembled
   * by the rank that owns them, no rank waits for another.
   *
   * What is passed to the constructor is kept by reference.
   */
  template <int dim>
  class FlowAssembly
  {
  public:
    FlowAssembly(const MovingMesh<dim>                &mesh,
                 const RigidBodies<dim>               &bodies,
                 const std::vector<NodeCoupling<dim>> &couplings,
                 FlowMatrices<dim>                    &matrices);

    /**
     * Assemble everything at the mesh's current positions.
     *
     * @param imposed_gradient gradient L_0 of the flow the disturbance is
     * counted against
     * @param with_preconditioner also the component matrices and the scaled
     * pressure mass matrix
     * @param body_force optional force per volume, for tests
     */
    void
    assemble(const StressModel<dim>       &stress,
             const dealii::Tensor<2, dim> &imposed_gradient,
             const bool                    with_preconditioner,
             const dealii::Function<dim>  *body_force = nullptr);

  private:
    using Offsets = typename FlowMatrices<dim>::Offsets;

    const MovingMesh<dim>                &mesh;
    const RigidBodies<dim>               &bodies;
    const std::vector<NodeCoupling<dim>> &couplings;
    FlowMatrices<dim>                    &matrices;

    void
    add_velocity_block(const FlowElement<dim> &element, const Offsets &offset);

    void
    add_pressure_blocks(const FlowElement<dim> &element, const Offsets &offset);

    void
    add_rigid_blocks(const FlowElement<dim> &element);

    void
    add_pressure_drop(const FlowElement<dim> &element);

    void
    add_pressure_drop_on_particles();

    void
    add_right_hand_side(const FlowElement<dim> &element);

    void
    add_preconditioner(const FlowElement<dim> &element, const Offsets &offset);

    void
    finish(const bool with_preconditioner);
  };
} // namespace Catena

#endif

#ifndef catena_flow_flow_assembly_h
#define catena_flow_flow_assembly_h

#include <catena/flow/flow_system.h>
#include <catena/flow/preconditioner_matrices.h>
#include <catena/flow/stress_model.h>

#include <deal.II/base/function.h>

namespace Catena
{
  /**
   * Evaluate the stress in all cells at the mesh's current positions, for the
   * products and the right-hand side of @p system.
   *
   * @param imposed_gradient gradient L_0 of the flow the disturbance is
   * counted against
   * @param preconditioner if it is not null, its matrices are assembled, too:
   * the rows of this rank, from its cells and the layer around them
   * @param body_force optional force per volume, for tests
   */
  template <int dim>
  void
  assemble_flow(const StressModel<dim>       &stress,
                const dealii::Tensor<2, dim> &imposed_gradient,
                FlowSystem<dim>              &system,
                PreconditionerMatrices<dim>  *preconditioner,
                const dealii::Function<dim>  *body_force = nullptr);
} // namespace Catena

#endif

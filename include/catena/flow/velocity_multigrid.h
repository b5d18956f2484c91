#ifndef catena_flow_velocity_multigrid_h
#define catena_flow_velocity_multigrid_h

#include <catena/base/types.h>
#include <catena/flow/coarse_correction.h>
#include <catena/flow/multigrid_level.h>
#include <catena/flow/preconditioner_matrices.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * One V-cycle for the scalar elliptic operator on P2 of the velocity
   * components: to P1 on the same mesh first, by interpolation, then to
   * aggregates of ever more nodes, and to a direct solution. The operators of
   * the coarser levels are P^T A P. Everything is in single precision.
   *
   * On P2 and P1 all components share the sweeps over one matrix; where their
   * boundary conditions differ, or the signs with which identified nodes come
   * back, there are LaneEntries. Component d is lane d.
   */
  template <int dim>
  class VelocityMultigrid
  {
  public:
    VelocityMultigrid() = default;

    VelocityMultigrid(const MovingMesh<dim>                &mesh,
                      const std::vector<NodeCoupling<dim>> &couplings,
                      const PreconditionerMatrices<dim>    &matrices);

    void
    vmult(FastVectorType &dst, const FastVectorType &src) const;

  private:
    std::unique_ptr<MultigridLevel>   finest;
    std::unique_ptr<CoarseCorrection> correction;
  };
} // namespace Catena

#endif

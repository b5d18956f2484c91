#ifndef catena_flow_node_multigrid_h
#define catena_flow_node_multigrid_h

#include <catena/base/types.h>
#include <catena/flow/coarse_inverse.h>
#include <catena/flow/multigrid_level.h>
#include <catena/flow/node_matrix.h>
#include <catena/flow/smoothed_aggregation.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * One V-cycle for a scalar elliptic operator on P2, applied to several fields
   * at once: to P1 on the same mesh first, by interpolation, then to
   * aggregates of ever more nodes, and to a direct solution. The operators of
   * the coarser levels are P^T A P. Everything is in single precision.
   *
   * Fields that have no unknown at a node take part with zero there, so that
   * velocity components with other boundary conditions share the sweeps over
   * the matrices.
   */
  class NodeMultigrid
  {
  public:
    /**
     * @param matrix rows of the operator on P2, of this rank's nodes
     * @param masks which fields have an unknown, by node
     * @param interpolation rows of the prolongation from the vertices
     * @param vertex_masks as masks, by vertex of this rank
     */
    NodeMultigrid(const SparseRows             &matrix,
                  const std::vector<FieldMask> &masks,
                  const SparseRows             &interpolation,
                  const std::vector<FieldMask> &vertex_masks,
                  const MPI_Comm                communicator);

    /**
     * Set @p components of the vector field @p dst by a cycle for those of
     * @p src.
     *
     * @param n_components of the vector fields
     */
    void
    vmult(VectorType                      &dst,
          const VectorType                &src,
          const std::vector<unsigned int> &components,
          const unsigned int               n_components) const;

  private:
    std::vector<std::unique_ptr<MultigridLevel>> levels;
    /// to a level from the next
    std::vector<NodeMatrix>        prolongations;
    std::unique_ptr<CoarseInverse> coarse_inverse;
    mutable NodeVector             coarse_solution, coarse_residual;

    void
    cycle(const unsigned int level) const;
  };
} // namespace Catena

#endif

#ifndef catena_flow_coarse_correction_h
#define catena_flow_coarse_correction_h

#include <catena/flow/coarse_inverse.h>
#include <catena/flow/multigrid_level.h>
#include <catena/flow/node_matrix.h>
#include <catena/flow/prolongation.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * The coarser levels of a multigrid below a given one: P C P^T r, where C is
   * a V-cycle for P^T A P that uses the correction of the next coarser level,
   * made of aggregates, or the inverse where the level is small. A level whose
   * aggregates are hardly fewer than its nodes, as on many ranks with few nodes
   * each, has no coarser one: it is left to its smoother.
   *
   * Fields with operators of their own share a level, which has no inverse, and
   * have coarser ones of their own.
   */
  class CoarseCorrection
  {
  public:
    /// What some of the fields share.
    struct FieldOperator
    {
      /// A of the finer level
      FieldMatrix matrix;
      /// the rows of P of this rank's nodes
      const SparseRows *prolongation;
    };

    /**
     * @param operators with entries in the same places, which can be zero
     * @param masks which fields have an unknown, by node of the coarser level;
     * a field without any is not corrected
     */
    CoarseCorrection(const std::vector<FieldOperator> &operators,
                     const std::vector<FieldMask>     &masks,
                     const MPI_Comm                    communicator);

    /// solution += P C P^T residual
    void
    correct(NodeVector &solution, const NodeVector &residual) const;

  private:
    Prolongation                    prolongation;
    std::unique_ptr<MultigridLevel> level;
    /// of the operators that have one
    std::vector<CoarseCorrection> coarser;
    /// in place of a level and what is coarser
    std::unique_ptr<CoarseInverse> inverse;
    mutable NodeVector             coarse_solution, coarse_residual;
  };
} // namespace Catena

#endif

#ifndef catena_flow_coarse_inverse_h
#define catena_flow_coarse_inverse_h

#include <catena/flow/node_matrix.h>

#include <deal.II/base/aligned_vector.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * Inverse of the operator on the coarsest level of a multigrid. Every rank
   * has all of it; fields with the same unknowns share one.
   */
  class CoarseInverse
  {
  public:
    /**
     * @param matrix rows of this rank
     * @param masks which fields have an unknown, by node of this rank
     */
    CoarseInverse(const SparseRows                          &matrix,
                  const std::vector<FieldMask>              &masks,
                  const dealii::Utilities::MPI::Partitioner &nodes);

    void
    vmult(NodeVector &dst, const NodeVector &src) const;

  private:
    MPI_Comm     communicator;
    unsigned int first, n_owned;

    /// The fields that are selected have the same unknowns.
    struct Part
    {
      std::vector<bool>         unknowns;
      dealii::FullMatrix<float> inverse;
      Lanes                     selection = {};
    };
    std::vector<Part>                    parts;
    mutable dealii::AlignedVector<float> values;

    static dealii::FullMatrix<float>
    invert(dealii::FullMatrix<double> matrix,
           const std::vector<bool>   &unknowns);
  };
} // namespace Catena

#endif

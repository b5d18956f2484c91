#ifndef catena_conformation_conformation_transfer_h
#define catena_conformation_conformation_transfer_h

#include <catena/base/types.h>
#include <catena/mesh/field_transfer.h>
#include <catena/mesh/point_tensors.h>

#include <vector>

namespace Catena
{
  /**
   * Carry the conformation c_p = exp(s) + c' of StressPrediction to the target
   * of @p transfer, @p mesh at @p positions. There s is the projection of
   * exp(s) that conserves its stress (EntropyProjection), with eigenvalues not
   * far below those that there were, and c' what then is missing to the whole
   * c_p: each cell has the stress that was in its volume.
   *
   * @param log_conformation components of s, replaced
   * @param unresolved c', none if it is zero; replaced
   * @throws SolverError
   */
  template <int dim>
  void
  transfer_conformation(const FieldTransfer<dim> &transfer,
                        const MovingMesh<dim>    &mesh,
                        const VectorType         &positions,
                        std::vector<VectorType>  &log_conformation,
                        PointTensors<dim>        &unresolved);
} // namespace Catena

#endif

#ifndef catena_flow_vertex_interpolation_h
#define catena_flow_vertex_interpolation_h

#include <catena/flow/node_couplings.h>
#include <catena/flow/node_matrix.h>

namespace Catena
{
  /**
   * Fields of P1 as fields of P2 on the same mesh: a node at the middle of an
   * edge has the mean of the values at its ends. Ends stand for themselves or
   * their masters, with a sign, as NodeCoupling tells.
   */
  template <int dim>
  class VertexInterpolation
  {
  public:
    /**
     * @param components of the velocity, which share the signs; the others are
     * in no mask
     */
    VertexInterpolation(const MovingMesh<dim>                &mesh,
                        const std::vector<NodeCoupling<dim>> &couplings,
                        const std::vector<unsigned int>      &components);

    /// by node of this rank
    std::vector<FieldMask> node_masks;
    SparseRows             prolongation;
    /// by vertex of this rank that has an unknown
    std::vector<FieldMask> vertex_masks;
  };
} // namespace Catena

#endif

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
    /// @param groups components of the velocity that share the signs, each in
    /// one of them
    VertexInterpolation(const MovingMesh<dim>                        &mesh,
                        const std::vector<NodeCoupling<dim>>         &couplings,
                        const std::vector<std::vector<unsigned int>> &groups);

    /// by node of this rank
    std::vector<FieldMask> node_masks;
    /// by group, with the same entries, which can be zero
    std::vector<SparseRows> prolongations;
    /// by vertex of this rank that has an unknown
    std::vector<FieldMask> vertex_masks;
  };
} // namespace Catena

#endif

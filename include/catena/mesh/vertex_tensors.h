#ifndef catena_mesh_vertex_tensors_h
#define catena_mesh_vertex_tensors_h

#include <catena/base/types.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * Values of a symmetric tensor field at the vertices of a cell.
   * @param components in the order of deal.II's SymmetricTensor
   */
  template <int dim>
  std::array<dealii::SymmetricTensor<2, dim>, n_linear_nodes(dim)>
  vertex_tensors(const typename MovingMesh<dim>::Cell &cell,
                 const std::vector<VectorType>        &components)
  {
    std::array<dealii::SymmetricTensor<2, dim>, n_linear_nodes(dim)> tensors;
    for (unsigned int v = 0; v < tensors.size(); ++v)
      for (unsigned int k = 0; k < components.size(); ++k)
        tensors[v].access_raw_entry(k) = components[k](cell.vertices[v]);
    return tensors;
  }
} // namespace Catena

#endif

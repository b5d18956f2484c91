#ifndef catena_mesh_cell_fields_h
#define catena_mesh_cell_fields_h

#include <catena/base/types.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <cmath>
#include <vector>

namespace Catena
{
  /// Where a node is, by a field of positions.
  template <int dim>
  dealii::Point<dim>
  node_position(const VectorType &positions, const unsigned int node)
  {
    dealii::Point<dim> position;
    for (unsigned int d = 0; d < dim; ++d)
      position[d] = positions(dim * node + d);
    return position;
  }



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



  /// Values of a vector field at the nodes of a cell.
  template <int dim>
  std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)>
  node_vectors(const typename MovingMesh<dim>::Cell &cell,
               const VectorType                     &field)
  {
    std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)> vectors;
    for (unsigned int a = 0; a < vectors.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        vectors[a][d] = field(dim * cell.nodes[a] + d);
    return vectors;
  }



  /// Value at a point of the vector field with these values at the nodes.
  template <int dim>
  dealii::Tensor<1, dim>
  value_at(
    const typename CellValues<dim>::PointValues                      &point,
    const std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)> &vectors)
  {
    dealii::Tensor<1, dim> value;
    for (unsigned int a = 0; a < vectors.size(); ++a)
      value += point.quadratic[a] * vectors[a];
    return value;
  }



  /// Its gradient L, with L_ij = d u_i / d x_j.
  template <int dim>
  dealii::Tensor<2, dim>
  gradient_at(
    const typename CellValues<dim>::PointValues                      &point,
    const std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)> &vectors)
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int a = 0; a < vectors.size(); ++a)
      gradient += outer_product(vectors[a], point.quadratic_gradient[a]);
    return gradient;
  }



  /// 2|w|/h at a point, with the length h of the element along @p w.
  template <int dim>
  double
  crossing_rate(const typename CellValues<dim>::PointValues &point,
                const dealii::Tensor<1, dim>                &w)
  {
    double rate = 0.;
    for (const auto &gradient : point.linear_gradient)
      rate += std::abs(w * gradient);
    return rate;
  }
} // namespace Catena

#endif

#ifndef catena_mesh_cell_fields_h
#define catena_mesh_cell_fields_h

#include <catena/base/types.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
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
   * Value of a symmetric tensor field at a vertex.
   * @param components in the order of deal.II's SymmetricTensor
   */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  vertex_tensor(const unsigned int             vertex,
                const std::vector<VectorType> &components)
  {
    dealii::SymmetricTensor<2, dim> tensor;
    for (unsigned int k = 0; k < components.size(); ++k)
      tensor.access_raw_entry(k) = components[k](vertex);
    return tensor;
  }



  /// Values of a symmetric tensor field at the vertices of a cell.
  template <int dim>
  std::array<dealii::SymmetricTensor<2, dim>, n_linear_nodes(dim)>
  vertex_tensors(const typename MovingMesh<dim>::Cell &cell,
                 const std::vector<VectorType>        &components)
  {
    std::array<dealii::SymmetricTensor<2, dim>, n_linear_nodes(dim)> tensors;
    for (unsigned int v = 0; v < tensors.size(); ++v)
      tensors[v] = vertex_tensor<dim>(cell.vertices[v], components);
    return tensors;
  }



  /// Values of a vector field at the nodes of a cell.
  template <int dim>
  NodeVectors<dim>
  node_vectors(const typename MovingMesh<dim>::Cell &cell,
               const VectorType                     &field)
  {
    NodeVectors<dim> vectors;
    for (unsigned int a = 0; a < n_quadratic_nodes(dim); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        vectors.components[d].set(a, field(dim * cell.nodes[a] + d));
    return vectors;
  }



  /// Where a point is in a cell with these nodes.
  template <int dim>
  dealii::Point<dim>
  position_at(const typename CellValues<dim>::PointValues   &point,
              const typename CellValues<dim>::NodePositions &nodes)
  {
    dealii::Point<dim> position;
    for (unsigned int a = 0; a < nodes.size(); ++a)
      position += point.quadratic[a] * dealii::Tensor<1, dim>(nodes[a]);
    return position;
  }



  /// Value at a point of the vector field with these values at the nodes.
  template <int dim>
  dealii::Tensor<1, dim>
  value_at(const typename CellValues<dim>::PointValues &point,
           const NodeVectors<dim>                      &vectors)
  {
    dealii::Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = point.quadratic * vectors.components[d];
    return value;
  }



  /// Its gradient L, with L_ij = d u_i / d x_j.
  template <int dim>
  dealii::Tensor<2, dim>
  gradient_at(const typename CellValues<dim>::PointValues &point,
              const NodeVectors<dim>                      &vectors)
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[i][j] =
          vectors.components[i] * point.quadratic_gradient.components[j];
    return gradient;
  }



  /// The results of @p function for the points of a pack, zero in lanes beyond.
  template <typename Packs, int dim, typename Function>
  Packs
  at_points(const CellValues<dim>                      &values,
            const typename CellValues<dim>::PackValues &pack,
            const Function                             &function)
  {
    Packs result;
    for (unsigned int k = 0; k < pack.n_points; ++k)
      set_lane(result, k, function(values.points()[pack.first + k]));
    return result;
  }

  /// value_at() of all points of a pack.
  template <int dim>
  dealii::Tensor<1, dim, Pack>
  values_at(const CellValues<dim>                      &values,
            const typename CellValues<dim>::PackValues &pack,
            const NodeVectors<dim>                     &vectors)
  {
    return at_points<dealii::Tensor<1, dim, Pack>>(
      values, pack, [&](const auto &point) {
        return value_at<dim>(point, vectors);
      });
  }

  /// gradient_at() of all points of a pack.
  template <int dim>
  dealii::Tensor<2, dim, Pack>
  gradients_at(const CellValues<dim>                      &values,
               const typename CellValues<dim>::PackValues &pack,
               const NodeVectors<dim>                     &vectors)
  {
    return at_points<dealii::Tensor<2, dim, Pack>>(
      values, pack, [&](const auto &point) {
        return gradient_at<dim>(point, vectors);
      });
  }



  /// The linear field with these tensors at the vertices, at the points.
  template <int dim>
  dealii::SymmetricTensor<2, dim, Pack>
  interpolate(const typename CellValues<dim>::PackValues &pack,
              const std::array<dealii::SymmetricTensor<2, dim>,
                               n_linear_nodes(dim)>      &vertices)
  {
    dealii::SymmetricTensor<2, dim, Pack> result;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
        result.access_raw_entry(k) +=
          pack.linear[v] * vertices[v].access_raw_entry(k);
    return result;
  }



  /// Its derivative w . grad at the points.
  template <int dim>
  dealii::SymmetricTensor<2, dim, Pack>
  derivative_along(const typename CellValues<dim>::PackValues &pack,
                   const dealii::Tensor<1, dim, Pack>         &w,
                   const std::array<dealii::SymmetricTensor<2, dim>,
                                    n_linear_nodes(dim)>      &vertices)
  {
    dealii::SymmetricTensor<2, dim, Pack> result;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        const Pack along_w = w * pack.linear_gradient[v];
        for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
          result.access_raw_entry(k) +=
            along_w * vertices[v].access_raw_entry(k);
      }
    return result;
  }



  /// 2|w|/h at the points, with the length h of the element along @p w.
  template <int dim>
  Pack
  crossing_rate(const typename CellValues<dim>::PackValues &pack,
                const dealii::Tensor<1, dim, Pack>         &w)
  {
    Pack rate = 0.;
    for (const auto &gradient : pack.linear_gradient)
      rate += abs(w * gradient);
    return rate;
  }
} // namespace Catena

#endif

#ifndef catena_mesh_linear_fit_h
#define catena_mesh_linear_fit_h

#include <catena/base/types.h>
#include <catena/mesh/quadratic_shape.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * The linear function on the reference cell that is closest (L2) to what is
   * given at the points of a rule.
   */
  template <int dim>
  struct LinearFit
  {
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    /// by point: the linear shape functions, and the weights of the values at
    /// the vertices
    std::vector<std::array<double, n_vertices>> linear, weights;

    explicit LinearFit(const dealii::Quadrature<dim> &rule)
    {
      // the mass matrix is volume/((d+1)(d+2)) (1 + delta_uv)
      constexpr double volume = dim == 2 ? 1. / 2. : 1. / 6.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          linear.push_back(barycentric_coordinates<dim>(rule.point(q)));
          weights.push_back(linear.back());
          for (double &weight : weights.back())
            weight =
              rule.weight(q) / volume * (dim + 1) * ((dim + 2) * weight - 1.);
        }
    }

    std::array<dealii::SymmetricTensor<2, dim>, n_vertices>
    values(const std::vector<dealii::SymmetricTensor<2, dim>> &at_points) const
    {
      std::array<dealii::SymmetricTensor<2, dim>, n_vertices> result;
      for (unsigned int q = 0; q < weights.size(); ++q)
        for (unsigned int v = 0; v < n_vertices; ++v)
          result[v] += weights[q][v] * at_points[q];
      return result;
    }

    /// At the points, the linear function with these values at the vertices.
    std::vector<dealii::SymmetricTensor<2, dim>>
    at_points(const std::array<dealii::SymmetricTensor<2, dim>, n_vertices>
                &vertices) const
    {
      std::vector<dealii::SymmetricTensor<2, dim>> result(linear.size());
      for (unsigned int q = 0; q < linear.size(); ++q)
        for (unsigned int v = 0; v < n_vertices; ++v)
          result[q] += linear[q][v] * vertices[v];
      return result;
    }
  };
} // namespace Catena

#endif

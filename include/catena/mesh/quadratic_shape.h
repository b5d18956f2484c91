#ifndef catena_mesh_quadratic_shape_h
#define catena_mesh_quadratic_shape_h

#include <catena/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Catena
{
  /**
   * The vertices at the ends of edge @p edge of a simplex, in the order of
   * FE_SimplexP(2): (0,1), (1,2), (2,0) and in three dimensions (0,3), (1,3),
   * (2,3). Node dim + 1 + edge of a quadratic simplex lies on that edge.
   */
  constexpr std::array<unsigned int, 2>
  simplex_edge(const unsigned int edge)
  {
    return edge < 3 ? std::array<unsigned int, 2>{{edge, (edge + 1) % 3}} :
                      std::array<unsigned int, 2>{{edge - 3, 3}};
  }



  /// Barycentric coordinates of a point of the reference simplex.
  template <int dim>
  inline std::array<double, dim + 1>
  barycentric_coordinates(const dealii::Point<dim> &unit)
  {
    std::array<double, dim + 1> lambda;
    lambda[0] = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lambda[d + 1] = unit[d];
        lambda[0] -= unit[d];
      }
    return lambda;
  }



  /**
   * Values of the quadratic Lagrange shape functions at a point of the
   * reference simplex, in the order of FE_SimplexP(2): L (2 L - 1) at the
   * vertices, 4 L_a L_b at the middle of the edge (a,b), with barycentric
   * coordinates L.
   */
  template <int dim>
  inline std::array<double, n_quadratic_nodes(dim)>
  quadratic_shape_values(const dealii::Point<dim> &unit)
  {
    const std::array<double, dim + 1> lambda = barycentric_coordinates(unit);

    std::array<double, n_quadratic_nodes(dim)> values;
    for (unsigned int v = 0; v <= dim; ++v)
      values[v] = lambda[v] * (2. * lambda[v] - 1.);
    for (unsigned int i = dim + 1; i < n_quadratic_nodes(dim); ++i)
      {
        const auto edge = simplex_edge(i - dim - 1);
        values[i]       = 4. * lambda[edge[0]] * lambda[edge[1]];
      }
    return values;
  }



  /**
   * Gradients of the quadratic shape functions with respect to the
   * coordinates of the reference simplex.
   */
  template <int dim>
  inline std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)>
  quadratic_shape_gradients(const dealii::Point<dim> &unit)
  {
    const std::array<double, dim + 1> lambda = barycentric_coordinates(unit);

    // component d of the gradient of L_v
    const auto slope = [](const unsigned int v, const unsigned int d) {
      return v == 0 ? -1. : (v == d + 1 ? 1. : 0.);
    };

    std::array<dealii::Tensor<1, dim>, n_quadratic_nodes(dim)> gradients;
    for (unsigned int d = 0; d < dim; ++d)
      {
        for (unsigned int v = 0; v <= dim; ++v)
          gradients[v][d] = (4. * lambda[v] - 1.) * slope(v, d);
        for (unsigned int i = dim + 1; i < n_quadratic_nodes(dim); ++i)
          {
            const auto edge = simplex_edge(i - dim - 1);
            gradients[i][d] = 4. * (lambda[edge[0]] * slope(edge[1], d) +
                                    lambda[edge[1]] * slope(edge[0], d));
          }
      }
    return gradients;
  }
} // namespace Catena

#endif

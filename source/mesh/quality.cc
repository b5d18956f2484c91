#include <catena/mesh/quadratic_shape.h>
#include <catena/mesh/quality.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using dealii::Point;
  using dealii::Tensor;

  template <>
  double
  simplex_volume<2>(const std::array<Point<2>, 3> &v)
  {
    const Tensor<1, 2> a = v[1] - v[0];
    const Tensor<1, 2> b = v[2] - v[0];
    return (a[0] * b[1] - a[1] * b[0]) / 2.;
  }



  template <>
  double
  simplex_volume<3>(const std::array<Point<3>, 4> &v)
  {
    return (v[1] - v[0]) * dealii::cross_product_3d(v[2] - v[0], v[3] - v[0]) /
           6.;
  }



  template <>
  double
  simplex_quality<2>(const std::array<Point<2>, 3> &v)
  {
    // with the sides a, b, c: r_in = 2A/(a+b+c) and R_circ = abc/(4A)
    const double a    = v[0].distance(v[1]);
    const double b    = v[1].distance(v[2]);
    const double c    = v[2].distance(v[0]);
    const double area = simplex_volume<2>(v);
    const double size = (a + b + c) * a * b * c;
    return size > 0. ? 16. * area * std::abs(area) / size : 0.;
  }



  template <>
  double
  simplex_quality<3>(const std::array<Point<3>, 4> &v)
  {
    const Tensor<1, 3> a = v[1] - v[0];
    const Tensor<1, 3> b = v[2] - v[0];
    const Tensor<1, 3> c = v[3] - v[0];

    const Tensor<1, 3> bc = dealii::cross_product_3d(b, c);
    const Tensor<1, 3> ca = dealii::cross_product_3d(c, a);
    const Tensor<1, 3> ab = dealii::cross_product_3d(a, b);

    // r_in = 3V/S with the surface S, and
    // R_circ = | |a|^2 b x c + |b|^2 c x a + |c|^2 a x b | / (12V)
    const double volume  = a * bc / 6.;
    const double surface = (ab.norm() + bc.norm() + ca.norm() +
                            dealii::cross_product_3d(b - a, c - a).norm()) /
                           2.;
    const double circle =
      (a.norm_square() * bc + b.norm_square() * ca + c.norm_square() * ab)
        .norm();
    const double size = surface * circle;
    return size > 0. ? 108. * volume * std::abs(volume) / size : 0.;
  }



  namespace
  {
    template <int dim>
    using NodeGradients = std::array<Tensor<1, dim>, n_quadratic_nodes(dim)>;

    /// Gradients of the shape functions at the nodes of the reference simplex.
    template <int dim>
    std::array<NodeGradients<dim>, n_quadratic_nodes(dim)>
    gradients_at_nodes()
    {
      std::array<Point<dim>, n_quadratic_nodes(dim)> nodes;
      for (unsigned int d = 0; d < dim; ++d)
        nodes[d + 1][d] = 1.;
      for (unsigned int i = dim + 1; i < n_quadratic_nodes(dim); ++i)
        {
          const auto edge = simplex_edge(i - dim - 1);
          nodes[i]        = (nodes[edge[0]] + nodes[edge[1]]) / 2.;
        }

      std::array<NodeGradients<dim>, n_quadratic_nodes(dim)> gradients;
      std::transform(nodes.begin(),
                     nodes.end(),
                     gradients.begin(),
                     quadratic_shape_gradients<dim>);
      return gradients;
    }
  } // namespace



  template <int dim>
  double
  quadratic_simplex_quality(
    const std::array<Point<dim>, n_quadratic_nodes(dim)> &nodes)
  {
    static const auto gradients_at = gradients_at_nodes<dim>();
    for (const NodeGradients<dim> &gradients : gradients_at)
      {
        Tensor<2, dim> jacobian;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          jacobian += outer_product(Tensor<1, dim>(nodes[i]), gradients[i]);
        if (!(determinant(jacobian) > 0.))
          return -1.;
      }

    std::array<Point<dim>, n_linear_nodes(dim)> vertices;
    std::copy_n(nodes.begin(), vertices.size(), vertices.begin());
    return simplex_quality<dim>(vertices);
  }



  template double
  quadratic_simplex_quality(const std::array<Point<2>, n_quadratic_nodes(2)> &);
  template double
  quadratic_simplex_quality(const std::array<Point<3>, n_quadratic_nodes(3)> &);
} // namespace Catena

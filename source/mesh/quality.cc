#include <catena/mesh/quality.h>

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
} // namespace Catena

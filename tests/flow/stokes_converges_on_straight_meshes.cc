// Without particles the disturbance of the shear is that which the body force
// drives. A flow made up from a vector potential, periodic in x, at rest on the
// walls and with the mirror planes of the box, is met with an L2 error of order
// 3 in the velocity and 2 in the pressure; with rotational symmetry also on the
// part of the box that its two cuts leave.

#include <deal.II/base/numbers.h>

#include <array>

#include "../tests.h"

#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

/**
 * A sum of products c B_odd(y) cos(kx x + phase_x) cos(kz z + phase_z) with
 * B = (1 - (2y/H)^2)^2, and times 2y/H if odd; any derivative of it.
 */
struct SeparableField
{
  struct Term
  {
    double coefficient;
    double wave_number_x, phase_x;
    bool   odd_in_y;
    double wave_number_z, phase_z;
  };
  std::vector<Term> terms;
  double            height;

  double
  derivative(const std::array<unsigned int, 3> &n,
             const std::array<double, 3>       &x) const
  {
    double sum = 0.;
    for (const Term &t : terms)
      sum += t.coefficient * wave(t.wave_number_x, t.phase_x, n[0], x[0]) *
             bump(t.odd_in_y, n[1], x[1]) *
             wave(t.wave_number_z, t.phase_z, n[2], x[2]);
    return sum;
  }

private:
  static double
  wave(const double k, const double phase, const unsigned int n, const double x)
  {
    return (n == 0 ? 1. : std::pow(k, n)) *
           std::cos(k * x + phase + n * numbers::PI_2);
  }

  double
  bump(const bool odd, const unsigned int n, const double y) const
  {
    // coefficients of the powers of eta = 2y/H
    std::vector<double> c = {1., 0., -2., 0., 1.};
    if (odd)
      c.insert(c.begin(), 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int k = 1; k < c.size(); ++k)
          c[k - 1] = k * c[k];
        c.pop_back();
      }
    double value = 0.;
    for (unsigned int k = c.size(); k-- > 0;)
      value = value * 2. * y / height + c[k];
    return value * std::pow(2. / height, n);
  }
};



/**
 * u' = curl A. Its parts with rotational symmetry, and @p skewness times parts
 * without it.
 */
template <int dim>
class PotentialFlow : public Tests::ExactFlow<dim>
{
public:
  PotentialFlow(const Scene<dim> &scene, const double skewness)
    : kx(2. * numbers::PI / scene.length)
    , ky(numbers::PI / scene.height)
    , kz(dim == 3 ? 2. * numbers::PI / scene.width : 0.)
    , skewness(skewness)
  {
    const double s = skewness, sine = -numbers::PI_2;
    for (auto &component : potential)
      component.height = scene.height;

    // even in z: u_x and u_y of it are mirror images of themselves
    potential[2].terms = {{0.3, kx, 0., false, 0., 0.},
                          {0.5, kx, sine, true, 0., 0.},
                          {0.2 * s, kx, sine, false, 0., 0.}};
    if (dim == 3)
      {
        potential[2].terms.push_back({0.3, kx, 0., false, kz, 0.});
        // odd in z
        potential[0].terms = {{0.3, kx, sine, false, kz, sine},
                              {0.4, kx, 0., true, kz, sine},
                              {0.2 * s, kx, 0., false, kz, sine}};
        potential[1].terms = {{0.2, kx, sine, false, kz, sine}};
      }
  }

  Tensor<1, dim>
  velocity(const Point<dim> &p) const override
  {
    return Scene<dim>::imposed_velocity(p) + curl(p, {{0, 0, 0}});
  }

  double
  pressure(const Point<dim> &p) const override
  {
    return std::cos(kx * p[0]) * std::cos(ky * p[1]) * wave(p) +
           std::sin(kx * p[0]) * (std::sin(ky * p[1]) + skewness);
  }

  /// -laplace u' + grad p
  Tensor<1, dim>
  force(const Point<dim> &p) const override
  {
    Tensor<1, dim> f = -1. * (curl(p, {{2, 0, 0}}) + curl(p, {{0, 2, 0}}));
    if (dim == 3)
      f -= curl(p, {{0, 0, 2}});

    const double cx = std::cos(kx * p[0]), sx = std::sin(kx * p[0]);
    const double cy = std::cos(ky * p[1]), sy = std::sin(ky * p[1]);
    f[0] += kx * (-sx * cy * wave(p) + cx * (sy + skewness));
    f[1] += ky * (-cx * sy * wave(p) + sx * cy);
    if (dim == 3)
      f[dim - 1] -= cx * cy * kz * std::sin(kz * p[dim - 1]);
    return f;
  }

private:
  const double                  kx, ky, kz, skewness;
  std::array<SeparableField, 3> potential;

  double
  wave(const Point<dim> &p) const
  {
    return dim == 3 ? 1. + std::cos(kz * p[dim - 1]) : 1.;
  }

  /// Derivative of order n of curl A.
  Tensor<1, dim>
  curl(const Point<dim> &p, const std::array<unsigned int, 3> &n) const
  {
    std::array<double, 3> x{};
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = p[d];
    const auto slope = [&](const unsigned int component, const unsigned int d) {
      auto orders = n;
      ++orders[d];
      return potential[component].derivative(orders, x);
    };
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
        u[d] = slope(f, e) - slope(e, f);
      }
    return u;
  }
};



template <int dim>
void
check(Tests::Claims             &claims,
      const std::string         &name,
      const Symmetry             symmetry,
      const Cut                  cut,
      const std::vector<double> &sizes)
{
  Scene<dim> scene;
  scene.length   = 2.;
  scene.height   = 2.;
  scene.width    = 2.;
  scene.symmetry = symmetry;
  scene.cut      = cut;
  const PotentialFlow<dim> exact(scene,
                                 symmetry == Symmetry::quarter ? 0. : 1.);

  const std::string title = name + " (" + std::to_string(dim) + "D): ";
  std::vector<Tests::StokesErrors> errors;
  for (const double size : sizes)
    {
      MeshParameters parameters;
      parameters.maximal_size = size;
      Tests::StokesProblem<dim> problem(scene, parameters);
      const unsigned int        n_iterations = problem.solve(&exact);
      errors.push_back(Tests::stokes_errors(problem, exact));
      Tests::print(title,
                   problem.mesh.n_global_cells(),
                   " cells, size ",
                   errors.back().size,
                   ", errors: velocity ",
                   errors.back().velocity,
                   ", pressure ",
                   errors.back().pressure,
                   ", iterations ",
                   n_iterations);
    }

  const auto &coarse = errors[errors.size() - 2], &fine = errors.back();
  claims.at_least(
    title + "the velocity is of order 3",
    Tests::order(coarse.velocity, fine.velocity, coarse.size, fine.size),
    2.8);
  claims.at_least(
    title + "the pressure is of order 2",
    Tests::order(coarse.pressure, fine.pressure, coarse.size, fine.size),
    1.8);
}



template <int dim>
void
check_all(Tests::Claims &claims, const std::vector<double> &sizes)
{
  check<dim>(claims, "whole box", Symmetry::none, Cut::x_plane, sizes);
  if (dim == 3)
    check<dim>(claims, "half box", Symmetry::half, Cut::x_plane, sizes);
  check<dim>(claims, "cut at x = 0", Symmetry::quarter, Cut::x_plane, sizes);
  check<dim>(claims, "cut at y = 0", Symmetry::quarter, Cut::y_plane, sizes);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check_all<2>(claims, {0.12, 0.06, 0.03});
    check_all<3>(claims, {0.28, 0.14});
  });
}

// A free particle in a sheared fluid that a body force drives to a known flow:
// with E the rate of strain of the imposed shear,
//
//   u' = curl(x x (E.x) g/dim),  g = exp(-k (r^2 - 1)^2),
//
// is -E.x on the surface of the particle, which so turns like the fluid far
// away without torque, and has died out at the walls. On meshes refined
// everywhere the L2 error is of order 3 in the velocity, of order 2 in the
// pressure, and the particle turns at half the shear rate.

#include <deal.II/base/numbers.h>
#include <deal.II/base/symmetric_tensor.h>

#include "../tests.h"

#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

/**
 * With s = r^2, q = x.E.x and c = 2/dim,
 *
 *   u' = a E.x + b q x,  a = -g - c s g', b = c g',
 *
 * in two dimensions from the stream function (x E_y - y E_x) g/2.
 */
template <int dim>
class FlowAroundParticle : public Tests::ExactFlow<dim>
{
public:
  FlowAroundParticle(const Scene<dim> &scene, const double decay)
    : decay(decay)
    , kx(2. * numbers::PI / scene.length)
    , ky(numbers::PI / scene.height)
    , kz(dim == 3 ? 2. * numbers::PI / scene.width : 0.)
    , E(symmetrize(Scene<dim>::imposed_gradient()))
  {}

  Tensor<1, dim>
  velocity(const Point<dim> &p) const override
  {
    const Tensor<1, dim> x(p), Ex = E * x;
    const Profiles       f = profiles(x.norm_square());
    return Scene<dim>::imposed_velocity(p) + f.a[0] * Ex +
           f.b[0] * (x * Ex) * x;
  }

  /// even under the rotation and in z: without force on the particle
  double
  pressure(const Point<dim> &p) const override
  {
    return std::cos(kx * p[0]) * std::cos(ky * p[1]) * wave(p) +
           std::sin(kx * p[0]) * std::sin(ky * p[1]);
  }

  /// -laplace u' + grad p
  Tensor<1, dim>
  force(const Point<dim> &p) const override
  {
    const Tensor<1, dim> x(p), Ex = E * x;
    const double         s = x.norm_square();
    const Profiles       f = profiles(s);

    Tensor<1, dim> force =
      -(4. * s * f.a[2] + (2. * dim + 4.) * f.a[1] + 4. * f.b[0]) * Ex -
      (4. * s * f.b[2] + (2. * dim + 8.) * f.b[1] + 4. * f.b[1]) * (x * Ex) * x;

    const double cx = std::cos(kx * p[0]), sx = std::sin(kx * p[0]);
    const double cy = std::cos(ky * p[1]), sy = std::sin(ky * p[1]);
    force[0] += kx * (-sx * cy * wave(p) + cx * sy);
    force[1] += ky * (-cx * sy * wave(p) + sx * cy);
    if (dim == 3)
      force[dim - 1] -= cx * cy * kz * std::sin(kz * p[dim - 1]);
    return force;
  }

private:
  const double                  decay, kx, ky, kz;
  const SymmetricTensor<2, dim> E;

  /// a and b with two derivatives with respect to s
  struct Profiles
  {
    std::array<double, 3> a, b;
  };

  Profiles
  profiles(const double s) const
  {
    const double t = s - 1., k = decay, g = std::exp(-k * t * t);
    const double g1 = -2. * k * t * g;
    const double g2 = (-2. * k + 4. * k * k * t * t) * g;
    const double g3 = (12. * k * k * t - 8. * k * k * k * t * t * t) * g;
    const double c  = 2. / dim;
    return {{{-g - c * s * g1,
              -(1. + c) * g1 - c * s * g2,
              -(1. + 2. * c) * g2 - c * s * g3}},
            {{c * g1, c * g2, c * g3}}};
  }

  double
  wave(const Point<dim> &p) const
  {
    return dim == 3 ? 1. + std::cos(kz * p[dim - 1]) : 1.;
  }
};



/// Largest deviation of the particle from turning at 1/2 on the spot.
template <int dim>
double
motion_error(const RigidMotion<dim> &motion)
{
  Tensor<1, 3> spin = motion.angular_velocity;
  spin[2] -= 0.5;
  return std::max(motion.velocity.norm(), spin.norm());
}



template <int dim>
void
check(Tests::Claims                   &claims,
      const std::string               &name,
      const Symmetry                   symmetry,
      const Cut                        cut,
      const std::vector<unsigned int> &elements_on_equator)
{
  constexpr double decay = 0.5;
  Scene<dim>       scene;
  scene.length    = 5.6;
  scene.height    = 5.6;
  scene.width     = 5.6;
  scene.symmetry  = symmetry;
  scene.cut       = cut;
  scene.particles = {{Point<dim>(), 1., symmetry == Symmetry::quarter}};
  const FlowAroundParticle<dim> exact(scene, decay);

  const std::string title = name + " (" + std::to_string(dim) + "D): ";
  std::vector<Tests::StokesErrors> errors;
  std::vector<double>              motion_errors;
  for (const unsigned int n : elements_on_equator)
    {
      // the largest element is as large as those on the particle
      MeshParameters parameters;
      parameters.elements_on_equator = n;
      parameters.maximal_size        = 2. * numbers::PI / n;
      Tests::StokesProblem<dim> problem(scene, parameters);
      const unsigned int        n_iterations = problem.solve(&exact);

      errors.push_back(Tests::stokes_errors(problem, exact));
      motion_errors.push_back(motion_error(problem.fields.motions[0]));
      Tests::print(title,
                   problem.mesh.n_global_cells(),
                   " cells, size ",
                   errors.back().size,
                   ", errors: velocity ",
                   errors.back().velocity,
                   ", pressure ",
                   errors.back().pressure,
                   ", motion ",
                   motion_errors.back(),
                   ", iterations ",
                   n_iterations);
    }

  const unsigned int n      = errors.size() - 1;
  const auto        &coarse = errors[n - 1], &fine = errors[n];
  claims.at_least(
    title + "the velocity is of order 3",
    Tests::order(coarse.velocity, fine.velocity, coarse.size, fine.size),
    2.8);
  claims.at_least(
    title + "the pressure is of order 2",
    Tests::order(coarse.pressure, fine.pressure, coarse.size, fine.size),
    1.8);
  // its error has no fixed sign and falls faster, by order 4 or so
  claims.at_most(title + "the particle turns at half the shear rate",
                 motion_errors[n],
                 dim == 2 ? 1e-6 : 1e-4);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const Cut                       x = Cut::x_plane, y = Cut::y_plane;
    const std::vector<unsigned int> n2 = {16, 32, 64}, n3 = {16, 24};
    check<2>(claims, "whole disc", Symmetry::none, x, n2);
    check<2>(claims, "disc cut at x = 0", Symmetry::quarter, x, n2);
    check<2>(claims, "disc cut at y = 0", Symmetry::quarter, y, n2);
    check<3>(claims, "half sphere", Symmetry::half, x, n3);
    check<3>(claims, "sphere cut at x = 0", Symmetry::quarter, x, n3);
    check<3>(claims, "sphere cut at y = 0", Symmetry::quarter, y, n3);
  });
}

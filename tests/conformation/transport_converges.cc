// The transport of the log-conformation against a manufactured solution: a
// Giesekus fluid in a prescribed flow, shear and a disturbance without
// divergence, with waves in s that move and change with time. The time step
// goes with the element size; the error in s falls with its square. The waves
// have the symmetries of the scene: period, mirror planes, rotation.

#include <catena/conformation/conformation_solver.h>

#include <array>
#include <complex>
#include <string>

#include "../tests.h"

#include "../print.h"
#include "fields.h"

using namespace Catena;
using namespace Catena::Tests;

/**
 * The exact fields. They take complex coordinates: the imaginary part of
 * f(x + i e) is e df/dx, to rounding.
 */
template <int dim>
class ManufacturedFlow
{
public:
  ManufacturedFlow(const Scene<dim> &scene)
    : kx(2. * dealii::numbers::PI / scene.length)
    , ky(dealii::numbers::PI / scene.height)
    , kz(2. * dealii::numbers::PI / scene.width)
    , phase(scene.rotational() ? 0. : 0.7)
  {}

  template <typename Number>
  using Coordinates = std::array<Number, dim>;

  /**
   * Shear with the stream function 0.3 cos(kx x + phase) cos(ky y)^2 times
   * cos(kz z), and in three dimensions a roll about y. Walls and mirror planes
   * are not crossed.
   */
  template <typename Number>
  std::array<Number, dim>
  velocity(const Coordinates<Number> &x) const
  {
    using std::cos;
    using std::sin;
    const Number a = kx * x[0] + phase, b = ky * x[1];

    std::array<Number, dim> u;
    u[0] = -x[1] - 0.3 * ky * cos(a) * sin(2. * b) * along_z<Number>(x, true);
    u[1] = 0.3 * kx * sin(a) * cos(b) * cos(b) * along_z<Number>(x, true);
    if constexpr (dim == 3)
      {
        u[0] += 0.2 * kz * sin(a) * cos(b) * along_z<Number>(x, true);
        u[2] = -0.2 * kx * cos(a) * cos(b) * along_z<Number>(x, false);
      }
    return u;
  }

  /// The components of s in the order of SymmetricTensor.
  template <typename Number>
  std::array<Number, n_symmetric_components(dim)>
  log_conformation(const Coordinates<Number> &x, const Number &t) const
  {
    using std::cos;
    std::array<Number, n_symmetric_components(dim)> s;
    for (unsigned int k = 0; k < s.size(); ++k)
      {
        const auto ij =
          dealii::SymmetricTensor<2, dim>::unrolled_to_component_indices(k);
        const bool odd = (ij[0] < 2) != (ij[1] < 2);
        // what is odd under the rotation is a sine of x and y
        const double shift = odd ? phase - dealii::numbers::PI_2 : phase;
        s[k]               = (odd ? 0. : 0.4 - 0.25 * k) +
               along_z<Number>(x, !odd) * cos(t + 1. * k) *
                 (0.3 * cos(kx * x[0] + (1. + k) * ky * x[1] + shift) +
                  0.2 * cos(kx * x[0] - 2. * ky * x[1] + shift));
      }
    return s;
  }

  dealii::Tensor<1, dim>
  velocity_at(const dealii::Point<dim> &p) const
  {
    const auto             u = velocity(coordinates<double>(p));
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = u[d];
    return result;
  }

  dealii::SymmetricTensor<2, dim>
  log_conformation_at(const dealii::Point<dim> &p, const double t) const
  {
    return tensor(log_conformation(coordinates<double>(p), t),
                  [](const double value) { return value; });
  }

  /// ds/dt + u.grad s - g(grad u, s)
  dealii::SymmetricTensor<2, dim>
  source(const Giesekus<dim>      &model,
         const dealii::Point<dim> &p,
         const double              t) const
  {
    using Complex             = std::complex<double>;
    constexpr double epsilon  = 1e-30;
    const auto       slope_of = [](const Complex &value) {
      return value.imag() / epsilon;
    };
    const auto x = coordinates<Complex>(p);
    auto source  = tensor(log_conformation(x, Complex(t, epsilon)), slope_of);

    const auto             u = velocity_at(p);
    dealii::Tensor<2, dim> L;
    for (unsigned int d = 0; d < dim; ++d)
      {
        auto moved = x;
        moved[d] += Complex(0., epsilon);
        source += u[d] * tensor(log_conformation(moved, Complex(t)), slope_of);
        const auto du = velocity(moved);
        for (unsigned int i = 0; i < dim; ++i)
          L[i][d] = slope_of(du[i]);
      }
    return source - model.log_conformation_rate(L,
                                                spectral_decomposition<dim>(
                                                  log_conformation_at(p, t)));
  }

private:
  const double kx, ky, kz, phase;

  template <typename Number>
  static Coordinates<Number>
  coordinates(const dealii::Point<dim> &p)
  {
    Coordinates<Number> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = p[d];
    return x;
  }

  /// Even or odd about the mirror planes
  template <typename Number>
  Number
  along_z(const Coordinates<Number> &x, const bool even) const
  {
    using std::cos;
    using std::sin;
    if constexpr (dim == 3)
      return even ? cos(kz * x[2]) : sin(kz * x[2]);
    else
      return Number(even ? 1. : 0.);
  }

  template <typename Values, typename Part>
  static dealii::SymmetricTensor<2, dim>
  tensor(const Values &values, const Part &part)
  {
    dealii::SymmetricTensor<2, dim> result;
    for (unsigned int k = 0; k < values.size(); ++k)
      result.access_raw_entry(k) = part(values[k]);
    return result;
  }
};



struct Result
{
  double size; ///< mean size of the elements
  double error;
};



/// From t = 0 to 1 on a mesh with elements of size h.
template <int dim>
Result
solve(const Scene<dim> &scene, const double h, const double steps_per_element)
{
  const MovingMesh<dim> mesh(MPI_COMM_WORLD, scene, uniform_mesh(scene, h));
  const ManufacturedFlow<dim> flow(scene);
  const VectorType           &positions = mesh.positions();

  GiesekusParameters fluid;
  fluid.weissenberg_number = 2.;
  fluid.mobility_parameter = 0.2;
  const Giesekus<dim> model(fluid);

  ConformationSolverParameters parameters;
  parameters.tolerance = 1e-10;
  ConformationSolver<dim> solver(model, parameters);
  solver.reinit(mesh);

  const auto velocity =
    interpolate_vector<dim>(mesh, positions, [&](const dealii::Point<dim> &p) {
      return flow.velocity_at(p);
    });
  const auto exact = [&](const double t) {
    return [&flow, t](const dealii::Point<dim> &p) {
      return flow.log_conformation_at(p, t);
    };
  };

  const unsigned int n_steps = std::lround(steps_per_element / h);
  TimeStep           step;
  step.dt = step.previous_dt = 1. / n_steps;
  auto older = interpolate_tensor<dim>(mesh, positions, exact(-step.dt));
  auto old   = interpolate_tensor<dim>(mesh, positions, exact(0.));
  for (unsigned int n = 1; n <= n_steps; ++n)
    {
      const double t   = n * step.dt;
      auto         now = old;
      solver.solve(now,
                   old,
                   older,
                   velocity,
                   mesh.vector_field(),
                   step,
                   [&](const dealii::Point<dim> &p) {
                     return flow.source(model, p, t);
                   });
      older = old;
      old   = now;
    }

  double volume = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    volume *= scene.upper()[d] - scene.lower()[d];
  return {std::pow(volume / mesh.n_global_cells(), 1. / dim),
          mean_error<dim>(mesh, old, exact(1.))};
}



/**
 * @param sizes of the elements, decreasing
 */
template <int dim>
void
check_order(Claims                    &claims,
            const std::string         &name,
            const Scene<dim>          &scene,
            const std::vector<double> &sizes,
            const double               steps_per_element)
{
  std::vector<Result> results;
  for (const double h : sizes)
    {
      results.push_back(solve(scene, h, steps_per_element));
      print(name,
            ": element size ",
            results.back().size,
            ", error ",
            results.back().error);
    }
  const Result &coarse = results.front(), &fine = results.back();
  claims.at_least(name + ", the error is of order 2",
                  std::log(coarse.error / fine.error) /
                    std::log(coarse.size / fine.size),
                  1.85);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const std::vector<double> sizes = {0.2, 0.1, 0.05};

    Scene<2> plane;
    plane.length = 4.;
    plane.height = 2.;
    // flow through 0.6 and 0.15 of an element in a step
    check_order<2>(claims, "dim 2, box, long steps", plane, sizes, 1.);
    check_order<2>(claims, "dim 2, box, short steps", plane, sizes, 4.);
    plane.symmetry = Symmetry::quarter;
    check_order<2>(claims, "dim 2, quarter", plane, sizes, 2.);
    plane.cut = Cut::y_plane;
    check_order<2>(claims, "dim 2, quarter cut at y = 0", plane, sizes, 2.);

    Scene<3> space;
    space.length   = 2.;
    space.height   = 2.;
    space.width    = 2.;
    space.symmetry = Symmetry::quarter;
    check_order<3>(claims, "dim 3, quarter", space, {0.2, 0.1}, 2.);
  });
}

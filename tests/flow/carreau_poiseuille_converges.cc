// A body force drives a Carreau fluid between two walls at rest: the velocity
// meets the exact one with an L2 error of order 3, and the flow rate that of
// tests/reference for every power index and time. The exact velocity comes
// from the balance eta(g) g = G |y|: with the half height 1,
//   u(y) = g(1) - g(y) |y| - [P(g(1)) - P(g(y))]/G,   P' = eta(g) g.

#include "../tests.h"

#include "carreau_problem.h"

using namespace dealii;
using namespace Catena;

class Poiseuille : public Tests::ExactFlow<2>
{
public:
  Poiseuille(const double power_index, const double time, const double gradient)
    : n(power_index)
    , lambda(time)
    , G(gradient)
    , model(Tests::carreau(power_index, time))
  {}

  /// The shear rate at which the stress is G |y|.
  double
  rate(const double y) const
  {
    const double stress = G * std::abs(y);
    double       low = 0., high = 10.;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = (low + high) / 2.;
        (model.viscosity(middle * middle) * middle < stress ? low : high) =
          middle;
      }
    return (low + high) / 2.;
  }

  Tensor<1, 2>
  velocity(const Point<2> &p) const override
  {
    const double wall = rate(1.), here = rate(p[1]);
    Tensor<1, 2> u;
    u[0] = wall - here * std::abs(p[1]) - (integral(wall) - integral(here)) / G;
    return u;
  }

  double
  pressure(const Point<2> &) const override
  {
    return 0.;
  }

  Tensor<1, 2>
  force(const Point<2> &) const override
  {
    Tensor<1, 2> f;
    f[0] = G;
    return f;
  }

private:
  const double  n, lambda, G;
  const Carreau model;

  double
  integral(const double g) const
  {
    return std::pow(1. + lambda * lambda * g * g, (n + 1.) / 2.) /
           (lambda * lambda * (n + 1.));
  }
};



double
mean_velocity(const Tests::CarreauProblem<2> &problem)
{
  CellValues<2> values;
  double        flux = 0., volume = 0.;
  for (const auto &cell : problem.mesh.cells())
    {
      values.reinit(problem.mesh.cell_positions(cell, problem.mesh.positions()),
                    false);
      for (const auto &point : values.points())
        {
          volume += point.JxW;
          for (unsigned int a = 0; a < problem.mesh.n_nodes; ++a)
            flux += point.JxW * point.quadratic[a] *
                    problem.fields.velocity(2 * cell.nodes[a]);
        }
    }
  return flux / volume;
}



void
check(Tests::Claims     &claims,
      const std::string &name,
      const Carreau     &model,
      const Poiseuille  &exact)
{
  Scene<2> scene;
  scene.length = 0.5;
  scene.height = 2.;

  std::vector<Tests::StokesErrors> errors;
  double                           mean = 0.;
  for (const double size : {0.1, 0.05, 0.025})
    {
      MeshParameters parameters;
      parameters.maximal_size = size;
      Tests::CarreauProblem<2> problem(scene, parameters, 1e-9);
      problem.configuration.shear_rate = 0.;
      problem.fields.velocity          = 0.;
      problem.solve(model, {}, &exact);
      errors.push_back(Tests::stokes_errors(problem, exact));
      mean = mean_velocity(problem);
      Tests::print(name,
                   ": size ",
                   errors.back().size,
                   ", errors: velocity ",
                   errors.back().velocity,
                   ", pressure ",
                   errors.back().pressure,
                   ", mean velocity ",
                   mean);
    }
  const auto &coarse = errors[1], &fine = errors[2];
  claims.at_least(
    name + ": the velocity is of order 3",
    Tests::order(coarse.velocity, fine.velocity, coarse.size, fine.size),
    2.8);
  claims.near(name + ": the flow rate", mean, 1., 1e-4);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const auto  table     = Tests::read_table("carreau_poiseuille.csv");
    const auto &indices   = table["n"];
    const auto &times     = table["lambda_c*Umean/H(half height)"];
    const auto &gradients = table["-dp/dx*H^2/(eta0*Umean)"];
    const auto &largest   = table["u_max/Umean"];
    const auto &rates     = table["wall_shear_rate*H/Umean"];
    for (unsigned int row = 0; row < table.n_rows; ++row)
      {
        const std::string name =
          "n = " + table.text.at("n")[row] + ", lambda_c = " +
          std::to_string(static_cast<int>(std::lround(10. * times[row]))) +
          "/10";
        const Poiseuille exact(indices[row], times[row], gradients[row]);
        claims.near(name + ": velocity in the middle",
                    exact.velocity(Point<2>())[0],
                    largest[row],
                    1e-8);
        claims.near(name + ": shear rate at the wall",
                    exact.rate(1.),
                    rates[row],
                    1e-8);
        check(claims, name, Tests::carreau(indices[row], times[row]), exact);
      }
  });
}

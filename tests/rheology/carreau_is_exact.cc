// The Carreau viscosity and its derivative agree with 100-digit arithmetic at
// rest and at every rate, the derivative is that of the viscosity, n = 1 is
// Newtonian, and plane Poiseuille flow is that of the reference table.

#include <catena/rheology/carreau.h>

#include <deal.II/base/quadrature_lib.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>

#include "../tests.h"

using namespace Catena;
using Number = boost::multiprecision::cpp_bin_float_100;

Carreau
make_model(const double time, const double n)
{
  CarreauParameters parameters;
  parameters.carreau_time = time;
  parameters.power_index  = n;
  return Carreau(parameters);
}



double
deviation(const double value, const Number &expected)
{
  return static_cast<double>(abs(value - expected) / abs(expected));
}



void
compare_with_formula(Tests::Claims &claims)
{
  double viscosity = 0., derivative = 0., difference = 0.;
  for (const double time : {0.01, 0.3, 1., 20.})
    for (const double n : {0.1, 0.25, 0.5, 0.9, 1.5, 2.})
      for (const double rate_squared : {0., 1e-20, 1e-6, 0.3, 1., 7., 1e8})
        {
          const Carreau model = make_model(time, n);
          const auto    exact = [&](const Number &x) {
            const Number base = 1 + Number(time) * time * x;
            return Number(pow(base, (Number(n) - 1) / 2));
          };
          const Number exact_derivative =
            (Number(n) - 1) / 2 * time * time * exact(rate_squared) /
            (1 + Number(time) * time * rate_squared);

          viscosity = std::max(viscosity,
                               deviation(model.viscosity(rate_squared),
                                         exact(rate_squared)));
          derivative =
            std::max(derivative,
                     deviation(model.viscosity_derivative(rate_squared),
                               exact_derivative));

          const Number h = (1 / (Number(time) * time) + rate_squared) * 1e-20;
          difference =
            std::max(difference,
                     deviation(model.viscosity_derivative(rate_squared),
                               (exact(rate_squared + h) -
                                exact(rate_squared - h)) /
                                 (2 * h)));
        }
  claims.at_most("the viscosity is exact", viscosity, 4e-15);
  claims.at_most("its derivative is exact", derivative, 4e-15);
  claims.at_most("it is the limit of differences", difference, 4e-15);
}



void
check_limits(Tests::Claims &claims)
{
  double newtonian = 0., rest = 0.;
  for (const double rate_squared : {0., 1e-3, 1., 1e6})
    for (const double parameter : {0.1, 1., 2.})
      {
        for (const Carreau &model :
             {make_model(parameter, 1.), make_model(0., parameter)})
          newtonian =
            std::max({newtonian,
                      std::abs(model.viscosity(rate_squared) - 1.),
                      std::abs(model.viscosity_derivative(rate_squared))});
        rest = std::max(rest,
                        std::abs(make_model(3., parameter).viscosity(0.) - 1.));
      }
  claims.at_most("n = 1 and lambda_c = 0 are Newtonian", newtonian, 0.);
  claims.at_most("the viscosity at rest is eta0", rest, 0.);

  const Carreau model = make_model(2., 0.3);
  claims.near("at high rates it is a power law",
              model.viscosity(1e16) / std::pow(2e8, -0.7),
              1.,
              1e-14);
}



/// The rate g that gives @p stress = eta(g) g > 0, by Newton's method in log g.
double
rate_of_stress(const Carreau &model, const double stress)
{
  double log_rate = std::log(stress);
  for (unsigned int k = 0; k < 200; ++k)
    {
      const double rate = std::exp(log_rate),
                   eta  = model.viscosity(rate * rate);
      const double slope =
        1. + 2. * rate * rate * model.viscosity_derivative(rate * rate) / eta;
      log_rate += std::log(stress / (eta * rate)) / slope;
    }
  return std::exp(log_rate);
}



void
compare_with_poiseuille_flow(Tests::Claims &claims)
{
  // Between walls at y = +-1 the shear stress is P y. The mean velocity is
  // the integral of y g, the largest one that of g.
  const auto              table = Tests::read_table("carreau_poiseuille.csv");
  const dealii::QGauss<1> quadrature(200);

  double error = 0.;
  for (unsigned int row = 0; row < table.n_rows; ++row)
    {
      const Carreau model =
        make_model(table["lambda_c*Umean/H(half height)"][row],
                   table["n"][row]);
      const double P = table["-dp/dx*H^2/(eta0*Umean)"][row];

      double mean = 0., largest = 0.;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          // Points are denser at the centre, where g bends.
          const double x      = quadrature.point(q)[0];
          const double y      = x * x * x;
          const double weight = 3. * x * x * quadrature.weight(q);
          const double rate   = rate_of_stress(model, P * y);
          mean += weight * y * rate;
          largest += weight * rate;
        }
      error = std::max({error,
                        deviation(mean, 1.),
                        deviation(largest, table["u_max/Umean"][row]),
                        deviation(rate_of_stress(model, P),
                                  table["wall_shear_rate*H/Umean"][row])});
    }
  claims.at_least("the table has rows", table.n_rows, 5);
  claims.at_most("plane Poiseuille flow is that of the table", error, 5e-9);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    compare_with_formula(claims);
    check_limits(claims);
    compare_with_poiseuille_flow(claims);
  });
}

// Steady uniaxial extension has the conformation of 100-digit arithmetic and
// satisfies the constitutive equation, for every rate and mobility; it has the
// Oldroyd-B, weak and strong limits; there is none where stresses grow for
// ever.

#include <catena/base/exceptions.h>
#include <catena/rheology/extensional_flow.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <limits>
#include <string>

#include "../tests.h"

#include "../refusal.h"
#include "giesekus.h"

using namespace Catena;
using Number = boost::multiprecision::cpp_bin_float_100;

double
deviation(const double value, const Number &expected)
{
  return static_cast<double>(abs(value - expected) / abs(expected));
}



/// The positive root c of alpha c^2 + (1 - k - 2 alpha) c - (1 - alpha) = 0.
Number
root(const Number &k, const Number &alpha)
{
  if (alpha == 0)
    return 1 / (1 - k);
  const Number b = 1 - k - 2 * alpha;
  return (sqrt(b * b + 4 * alpha * (1 - alpha)) - b) / (2 * alpha);
}



const std::vector<double> products =
  {1e-9, 1e-3, 0.3, 0.49, 0.5, 0.51, 1., 1. + 1e-9, 5., 100., 1e6};
const std::vector<double> mobilities =
  {0., 1e-15, 1e-8, 0.1, 0.5, 0.8, 1. - 1e-12, 1.};



void
compare_with_many_digits(Tests::Claims &claims)
{
  double conformation = 0., viscosity = 0.;
  for (const double rate : products)
    for (const double sign : {1., -1.})
      for (const double alpha : mobilities)
        {
          const double beta = 0.1;
          const auto   state =
            steady_extension(Tests::giesekus(1., alpha, beta), sign * rate);
          if (!state)
            continue;

          const Number axial  = root(2 * Number(sign * rate), alpha);
          const Number radial = root(-Number(sign * rate), alpha);
          conformation =
            std::max(conformation, deviation(state->axial_conformation, axial));
          // For alpha = 1 and strong extension the radius goes to zero.
          if (radial > 0)
            conformation =
              std::max(conformation,
                       deviation(state->radial_conformation, radial));
          else
            conformation = std::max(conformation, state->radial_conformation);
          viscosity = std::max(viscosity,
                               deviation(state->viscosity,
                                         3 * Number(beta) + (1 - Number(beta)) *
                                                              (axial - radial) /
                                                              (sign * rate)));
        }
  claims.at_most("the conformation is exact", conformation, 2e-15);
  claims.at_most("the viscosity is exact", viscosity, 2e-15);
}



void
check_constitutive_equation(Tests::Claims &claims)
{
  double residual = 0.;
  for (const double Wi : {1e-3, 1., 30.})
    for (const double product : products)
      for (const double alpha : mobilities)
        {
          const auto   parameters = Tests::giesekus(Wi, alpha, 0.);
          const double rate       = product / Wi;
          const auto   state      = steady_extension(parameters, rate);
          if (!state)
            continue;
          const auto   c = state->conformation();
          const double scale =
            rate * c.norm() + (c.norm() + alpha * c.norm() * c.norm()) / Wi;
          const auto change = Giesekus<3>(parameters)
                                .conformation_rate(uniaxial_extension(rate), c);
          residual = std::max(residual, change.norm() / scale);
        }
  claims.at_most("the constitutive equation is satisfied", residual, 1e-15);
}



void
check_limits(Tests::Claims &claims)
{
  double oldroyd_b = 0., weak = 0., strong = 0.;
  for (const double beta : {0., 0.1, 0.9})
    {
      for (const double W : {1e-9, 0.1, 0.4, 0.499})
        {
          // W and beta are rounded: the formula is exact for what they are.
          const Number product = W;
          const auto state = steady_extension(Tests::giesekus(W, 0., beta), 1.);
          oldroyd_b        = std::max(
            {oldroyd_b,
                    deviation(state->axial_conformation, 1 / (1 - 2 * product)),
                    deviation(state->radial_conformation, 1 / (1 + product)),
                    deviation(state->viscosity,
                       3 * Number(beta) +
                         3 * (1 - Number(beta)) /
                           ((1 - 2 * product) * (1 + product)))});
        }
      for (const double alpha : {0., 0.3, 1.})
        weak =
          std::max(weak,
                   deviation(steady_extension(Tests::giesekus(2., alpha, beta),
                                              1e-16)
                               ->viscosity,
                             3));
      for (const double alpha : {0.01, 0.3, 1.})
        strong = std::max(
          strong,
          deviation(
            steady_extension(Tests::giesekus(2., alpha, beta), 1e14)->viscosity,
            3 * beta + 2 * (1 - beta) / alpha));
    }
  claims.at_most("alpha = 0 is Oldroyd-B", oldroyd_b, 2e-15);
  claims.at_most("eta_E -> 3 eta0 in weak extension", weak, 2e-15);
  claims.at_most("eta_E -> 3 eta_s + 2 eta_p/alpha in strong extension",
                 strong,
                 2e-12);

  const auto at_rest = steady_extension(Tests::giesekus(2., 0.3, 0.1), 0.);
  claims.near("eta_E = 3 eta0 at rest", at_rest->viscosity, 3., 1e-15);
  claims.near("c = I at rest",
              (at_rest->conformation() -
               dealii::unit_symmetric_tensor<3, double>())
                .norm(),
              0.,
              0.);
}



void
check_existence(Tests::Claims &claims)
{
  const auto exists = [](const double alpha, const double product) {
    return steady_extension(Tests::giesekus(2., alpha, 0.1), product / 2.)
      .has_value();
  };
  const double almost_half = 0.5 - 1e-15;
  claims.holds("Oldroyd-B has a steady state below Wi rate = 1/2",
               exists(0., almost_half));
  claims.holds("Oldroyd-B has none at 1/2", !exists(0., 0.5));
  claims.holds("Oldroyd-B has none above 1/2", !exists(0., 3.));
  claims.holds("Oldroyd-B has none in biaxial extension from Wi rate = -1",
               exists(0., -0.99) && !exists(0., -1.) && !exists(0., -7.));
  claims.holds("Giesekus always has one",
               exists(1e-6, 0.5) && exists(1e-6, 1e3) && exists(1., -1e3));
}



bool
is_refused(const double alpha, const double rate)
{
  return !Tests::refusal([&]() {
            steady_extension(Tests::giesekus(1., alpha, 0.1), rate);
          }).empty();
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    compare_with_many_digits(claims);
    check_constitutive_equation(claims);
    check_limits(claims);
    check_existence(claims);
    claims.holds("a negative mobility is refused", is_refused(-0.1, 1.));
    claims.holds("an infinite rate is refused",
                 is_refused(0.1, std::numeric_limits<double>::infinity()));
  });
}

// The closed form of steady shear gives every row of the reference table,
// satisfies the constitutive equation for every mobility including 0 and 1,
// and has the Oldroyd-B and small-Wi limits to rounding.

#include <catena/rheology/shear_flow.h>

#include <algorithm>
#include <string>

#include "../tests.h"

#include "giesekus.h"

using namespace Catena;

double
deviation(const double value, const double expected)
{
  return std::abs(value - expected) / std::abs(expected);
}



void
compare_with_table(Tests::Claims &claims)
{
  const auto         table  = Tests::read_table("giesekus_simple_shear.csv");
  const unsigned int n_rows = table.n_rows;

  double error = 0.;
  for (unsigned int row = 0; row < n_rows; ++row)
    {
      const SteadyShear state = steady_shear(Tests::giesekus(
        table["Wi"][row], table["alpha"][row], table["beta"][row]));
      error =
        std::max({error,
                  deviation(state.viscosity, table["eta_over_eta0"][row]),
                  deviation(state.first_normal_stress_difference,
                            table["N1_over_G"][row]),
                  deviation(state.second_normal_stress_difference,
                            table["N2_over_G"][row]),
                  deviation(state.shear_stress, table["tauxy_p_over_G"][row]),
                  deviation(state.elasticity_parameter, table["S"][row])});
    }
  claims.at_least("the table has rows", n_rows, 100);
  claims.at_most("every row of the table is met to its last digit",
                 error,
                 5e-10);
}



template <int dim>
void
check_constitutive_equation(Tests::Claims &claims)
{
  dealii::Tensor<2, dim> L;
  L[0][1] = 1.;

  double residual = 0.;
  for (const double Wi : {1e-6, 1e-3, 0.1, 1., 5., 100., 1e4})
    for (const double alpha : {0., 1e-15, 1e-8, 0.1, 0.5, 0.8, 1. - 1e-12, 1.})
      {
        const auto          parameters = Tests::giesekus(Wi, alpha, 0.1);
        const auto          c = steady_shear(parameters).conformation<dim>();
        const Giesekus<dim> model(parameters);

        const double scale =
          c.norm() + (c.norm() + alpha * c.norm() * c.norm()) / Wi;
        residual =
          std::max(residual, model.conformation_rate(L, c).norm() / scale);
      }
  claims.at_most("dim " + std::to_string(dim) +
                   ", the constitutive equation is satisfied",
                 residual,
                 1e-15);
}



void
check_limits(Tests::Claims &claims)
{
  double oldroyd_b = 0., continuity = 0., small_shear = 0.;
  for (const double beta : {0., 0.1, 0.9})
    {
      for (const double Wi : {1e-8, 0.3, 1., 20.})
        {
          const auto state = steady_shear(Tests::giesekus(Wi, 0., beta));
          oldroyd_b        = std::max(
            {oldroyd_b,
                    deviation(state.viscosity, 1.),
                    deviation(state.shear_stress, Wi),
                    deviation(state.first_normal_stress_difference, 2. * Wi * Wi),
                    std::abs(state.second_normal_stress_difference),
                    deviation(state.elasticity_parameter, (1. - beta) * Wi)});

          // f = alpha Wi^2 + O(alpha^2)
          const auto close = steady_shear(Tests::giesekus(Wi, 1e-18, beta));
          continuity       = std::max(
            {continuity,
                   deviation(close.first_normal_stress_difference, 2. * Wi * Wi),
                   deviation(close.second_normal_stress_difference,
                       -1e-18 * Wi * Wi)});
        }

      const double Wi    = 1e-9;
      const auto   state = steady_shear(Tests::giesekus(Wi, 0.3, beta));
      small_shear        = std::max(
        {small_shear,
                deviation(state.first_normal_stress_difference, 2. * Wi * Wi),
                deviation(state.second_normal_stress_difference, -0.3 * Wi * Wi),
                deviation(state.elasticity_parameter, (1. - beta) * Wi)});
    }
  claims.at_most("alpha = 0 is Oldroyd-B", oldroyd_b, 1e-15);
  claims.at_most("alpha -> 0 is continuous", continuity, 1e-14);
  claims.at_most("Wi -> 0 is the second-order fluid", small_shear, 1e-15);
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    compare_with_table(claims);
    check_constitutive_equation<2>(claims);
    check_constitutive_equation<3>(claims);
    check_limits(claims);
  });
}

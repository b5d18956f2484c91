// The rheometer gives the rows of the reference tables of shear, its start-up
// ends in its steady flows and begins as linear viscoelasticity, Oldroyd-B in
// extension is exact also where it has no steady state, and fluids without
// elasticity have a viscosity only.

#include <catena/base/exceptions.h>
#include <catena/rheology/rheometer.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../tests.h"

#include "../refusal.h"
#include "giesekus.h"

using namespace Catena;
using Model = FluidParameters::Model;

Rheometer
make_giesekus(const double Wi, const double alpha, const double beta)
{
  FluidParameters fluid;
  fluid.model    = Model::giesekus;
  fluid.giesekus = Tests::giesekus(Wi, alpha, beta);
  return Rheometer(fluid);
}



Rheometer
make_inelastic(const Model model, const double time, const double n)
{
  FluidParameters fluid;
  fluid.model                = model;
  fluid.carreau.carreau_time = time;
  fluid.carreau.power_index  = n;
  return Rheometer(fluid);
}



double
deviation(const double value, const double expected)
{
  return std::abs(value - expected) / std::abs(expected);
}



void
compare_with_steady_table(Tests::Claims &claims)
{
  const auto table = Tests::read_table("giesekus_simple_shear.csv");
  double     error = 0.;
  for (unsigned int row = 0; row < table.n_rows; ++row)
    // Wi as a relaxation time, as a rate, and shared between them
    for (const double rate : {1., table["Wi"][row], 3.})
      {
        const double beta   = table["beta"][row];
        const double lambda = table["Wi"][row] / rate;
        const double G      = (1. - beta) / lambda;
        const auto   state =
          make_giesekus(lambda, table["alpha"][row], beta).steady_shear(rate);
        error =
          std::max({error,
                    deviation(state.viscosity, table["eta_over_eta0"][row]),
                    deviation(state.first_normal_stress_difference,
                              G * table["N1_over_G"][row]),
                    deviation(state.second_normal_stress_difference,
                              G * table["N2_over_G"][row]),
                    deviation(state.elasticity_parameter, table["S"][row])});
      }
  claims.at_least("the table of steady shear has rows", table.n_rows, 100);
  claims.at_most("steady shear is that of the table to its last digit",
                 error,
                 5e-10);
}



void
compare_with_start_up_table(Tests::Claims &claims)
{
  const auto   table = Tests::read_table("giesekus_startup.csv");
  const double beta  = 0.2;
  double       error = 0.;
  for (unsigned int row = 0; row < table.n_rows; ++row)
    {
      // With a relaxation time of 1 the rate is Wi.
      const double rate = table["Wi"][row];
      const auto   state =
        make_giesekus(1., table["alpha"][row], beta)
          .start_up_shear(rate, {table["t_over_lambda"][row]})[0];

      const double G            = 1. - beta;
      const double scale        = 1. + table["cxx"][row];
      const double shear_stress = beta * rate + G * table["cxy"][row];
      const double N1           = G * table["N1_over_G"][row];
      error                     = std::max(
        {error,
                             std::abs(state.viscosity * rate - shear_stress) / scale,
                             std::abs(state.first_normal_stress_difference - N1) / scale,
                             std::abs(state.second_normal_stress_difference -
                  G * table["N2_over_G"][row]),
                             std::abs(state.elasticity_parameter - 0.5 * N1 / shear_stress) /
                               scale});
    }
  claims.at_least("the table of start-up has rows", table.n_rows, 100);
  claims.at_most("start-up of shear is that of the table", error, 1e-10);
}



void
check_start_up_ends_in_steady_flow(Tests::Claims &claims)
{
  double shear = 0., extension = 0.;
  for (const double Wi : {0.1, 1., 8.})
    for (const double alpha : {0., 0.01, 0.2, 0.5, 0.9})
      for (const double rate : {0.1, 0.4, 3.})
        {
          const auto                rheometer = make_giesekus(Wi, alpha, 0.1);
          const std::vector<double> late      = {300. * Wi};

          const auto steady = rheometer.steady_shear(rate);
          const auto end    = rheometer.start_up_shear(rate, late)[0];
          if (alpha <= 0.5)
            shear = std::max(
              {shear,
               deviation(end.viscosity, steady.viscosity),
               deviation(end.first_normal_stress_difference,
                         steady.first_normal_stress_difference),
               deviation(end.elasticity_parameter, steady.elasticity_parameter),
               std::abs(end.second_normal_stress_difference -
                        steady.second_normal_stress_difference)});

          if (const auto viscosity = rheometer.steady_extension(rate))
            extension =
              std::max(extension,
                       deviation(rheometer.start_up_extension(rate, late)[0],
                                 *viscosity));
        }
  claims.at_most("start-up of shear ends in steady shear", shear, 1e-9);
  claims.at_most("start-up of extension ends in steady extension",
                 extension,
                 1e-9);
}



void
check_weak_flow(Tests::Claims &claims)
{
  // eta+(t) = beta + (1 - beta) (1 - e^{-t/lambda}), eta_E+ = 3 eta+
  const double              Wi = 2., beta = 0.1, rate = 1e-6;
  const std::vector<double> times     = {0.01, 0.1, 1., 5., 100.};
  const auto                rheometer = make_giesekus(Wi, 0.3, beta);
  const auto                shear     = rheometer.start_up_shear(rate, times);
  const auto extension = rheometer.start_up_extension(rate, times);

  double shear_error = 0., extension_error = 0.;
  for (unsigned int n = 0; n < times.size(); ++n)
    {
      const double growth = beta - (1. - beta) * std::expm1(-times[n] / Wi);
      shear_error =
        std::max(shear_error, deviation(shear[n].viscosity, growth));
      extension_error =
        std::max(extension_error, deviation(extension[n], 3. * growth));
    }
  claims.at_most("weak shear is linear viscoelasticity", shear_error, 1e-9);
  claims.at_most("weak extension is 3 times that", extension_error, 1e-5);
  claims.near("at a small rate eta_E+ goes to 3 eta0",
              extension.back(),
              3.,
              1e-5);
}



void
check_oldroyd_b_extension(Tests::Claims &claims)
{
  // c_ii = e^{a t} + (e^{a t} - 1)/(a Wi) with a = 2 L_ii - 1/Wi
  const double              Wi = 2., beta = 0.25;
  const std::vector<double> times     = {0., 0.3, 1., 4., 10.};
  const auto                rheometer = make_giesekus(Wi, 0., beta);

  double error = 0.;
  for (const double rate : {0.1, 0.24, 1., 3.})
    {
      const auto curve = rheometer.start_up_extension(rate, times);
      for (unsigned int n = 0; n < times.size(); ++n)
        {
          const auto component = [&](const double stretching) {
            const double growth = 2. * stretching - 1. / Wi;
            return std::exp(growth * times[n]) +
                   std::expm1(growth * times[n]) / (growth * Wi);
          };
          const double expected =
            3. * beta + (1. - beta) / Wi *
                          (component(rate) - component(-0.5 * rate)) / rate;
          error = std::max(error, deviation(curve[n], expected));
        }
    }
  claims.at_most("start-up of extension of Oldroyd-B is exact", error, 1e-10);
  claims.holds("it has no steady state at Wi rate >= 1/2",
               rheometer.steady_extension(0.24) &&
                 !rheometer.steady_extension(0.25) &&
                 !rheometer.steady_extension(1.));
}



void
check_inelastic_fluids(Tests::Claims &claims)
{
  const double time = 2., n = 0.4;
  const auto   newtonian = make_inelastic(Model::newtonian, time, n);
  const auto   carreau   = make_inelastic(Model::carreau, time, n);

  double newtonian_error = 0., carreau_error = 0., normal = 0., start_up = 0.;
  for (const double rate : {1e-3, 0.5, 1., 40.})
    {
      const double x         = time * rate;
      const double eta       = std::pow(1. + x * x, 0.5 * (n - 1.));
      const double stretched = std::pow(1. + 3. * x * x, 0.5 * (n - 1.));

      newtonian_error =
        std::max({newtonian_error,
                  deviation(newtonian.steady_shear(rate).viscosity, 1.),
                  deviation(*newtonian.steady_extension(rate), 3.)});
      carreau_error =
        std::max({carreau_error,
                  deviation(carreau.steady_shear(rate).viscosity, eta),
                  deviation(*carreau.steady_extension(rate), 3. * stretched)});
      for (const Rheometer &rheometer : {newtonian, carreau})
        {
          const auto steady = rheometer.steady_shear(rate);
          normal            = std::max({normal,
                                        std::abs(steady.first_normal_stress_difference),
                                        std::abs(steady.second_normal_stress_difference),
                                        std::abs(steady.elasticity_parameter),
                                        rheometer.weissenberg_number(rate)});
          for (const auto &state : rheometer.start_up_shear(rate, {0.1, 1.}))
            start_up =
              std::max(start_up, std::abs(state.viscosity - steady.viscosity));
          for (const double eta_E :
               rheometer.start_up_extension(rate, {0.1, 1.}))
            start_up =
              std::max(start_up,
                       std::abs(eta_E - *rheometer.steady_extension(rate)));
        }
    }
  claims.at_most("the Newtonian fluid has the viscosities 1 and 3",
                 newtonian_error,
                 0.);
  claims.at_most("the Carreau fluid has eta(rate) and 3 eta(sqrt(3) rate)",
                 carreau_error,
                 1e-14);
  claims.at_most("there are no normal stresses without elasticity", normal, 0.);
  claims.at_most("there is no start-up without elasticity", start_up, 0.);
}



bool
rate_is_refused(const double rate)
{
  const auto rheometer = make_giesekus(1., 0.1, 0.1);
  return !Tests::refusal([&]() { rheometer.steady_shear(rate); }).empty();
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    compare_with_steady_table(claims);
    compare_with_start_up_table(claims);
    check_start_up_ends_in_steady_flow(claims);
    check_weak_flow(claims);
    check_oldroyd_b_extension(claims);
    check_inelastic_fluids(claims);
    claims.near("without solvent there is no stress at time 0",
                make_giesekus(1., 0.1, 0.)
                  .start_up_shear(2., {0.})[0]
                  .elasticity_parameter,
                0.,
                0.);
    claims.holds("rates that are not positive are refused",
                 rate_is_refused(0.) && rate_is_refused(-1.));
  });
}

// The start-up of homogeneous flows: every row of the reference table for
// shear, its steady state against the closed form, Oldroyd-B in extension
// against the analytic solution, and rotation, which does nothing.

#include <catena/base/exceptions.h>
#include <catena/rheology/shear_flow.h>

#include <algorithm>
#include <limits>
#include <string>

#include "../tests.h"

#include "../refusal.h"

using namespace Catena;

template <int dim>
Giesekus<dim>
make_model(const double Wi, const double alpha)
{
  GiesekusParameters parameters;
  parameters.weissenberg_number = Wi;
  parameters.mobility_parameter = alpha;
  return Giesekus<dim>(parameters);
}



template <int dim>
void
compare_with_table(Tests::Claims &claims)
{
  const auto         table  = Tests::read_table("giesekus_startup.csv");
  const unsigned int n_rows = table.n_rows;

  dealii::Tensor<2, dim> L;
  L[0][1] = 1.;

  double error = 0.;
  for (unsigned int row = 0; row < n_rows;)
    {
      // One curve: the rows of one Wi and alpha, with increasing time.
      const double Wi    = table["Wi"][row];
      const double alpha = table["alpha"][row];

      std::vector<double> times;
      unsigned int        end = row;
      while (end < n_rows && table["Wi"][end] == Wi &&
             table["alpha"][end] == alpha &&
             (times.empty() || table["strain"][end] >= times.back()))
        times.push_back(table["strain"][end++]);

      const auto curve = start_up(make_model<dim>(Wi, alpha), L, times);
      for (const auto &c : curve)
        {
          const auto   s     = logarithm(c);
          const double scale = c.norm();
          const auto   compare =
            [&](const double value, const char *column, const double size) {
              error =
                std::max(error, std::abs(value - table[column][row]) / size);
            };
          compare(c[0][0], "cxx", scale);
          compare(c[0][1], "cxy", scale);
          compare(c[1][1], "cyy", 1.);
          compare(c[0][0] - c[1][1], "N1_over_G", scale);
          compare(c[1][1] - 1., "N2_over_G", 1.);
          compare(s[0][0], "s_xx", 1.);
          compare(s[0][1], "s_xy", 1.);
          compare(s[1][1], "s_yy", 1.);
          ++row;
        }
    }
  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_least(name + "the table has rows", n_rows, 100);
  claims.at_most(name + "every row of the table is met", error, 2e-11);
}



template <int dim>
void
compare_with_steady_state(Tests::Claims &claims)
{
  dealii::Tensor<2, dim> L;
  L[0][1] = 1.;

  double error = 0.;
  for (const double Wi : {0.1, 1., 5., 20.})
    for (const double alpha : {0., 0.01, 0.2, 0.5})
      {
        GiesekusParameters parameters;
        parameters.weissenberg_number = Wi;
        parameters.mobility_parameter = alpha;

        const auto c      = start_up(Giesekus<dim>(parameters), L, {50. * Wi});
        const auto steady = steady_shear(parameters).conformation<dim>();
        error = std::max(error, (c[0] - steady).norm() / c[0].norm());
      }
  claims.at_most("dim " + std::to_string(dim) +
                   ", start-up ends in the closed form",
                 error,
                 1e-10);
}



template <int dim>
void
compare_with_extension(Tests::Claims &claims)
{
  // In the directions of the eigenvalues e_i of L, here in a turned frame,
  // dc_ii/dt = a_i c_ii + 1/Wi with a_i = 2 e_i - 1/Wi.
  const double Wi = 2., strain_rate = 0.7, c45 = std::sqrt(0.5);

  dealii::Tensor<2, dim> R = dealii::unit_symmetric_tensor<dim>();
  R[0][0] = R[1][1] = R[1][0] = c45;
  R[0][1]                     = -c45;
  dealii::Tensor<2, dim> rates;
  rates[0][0] = strain_rate;
  for (unsigned int i = 1; i < dim; ++i)
    rates[i][i] = -strain_rate / (dim - 1);

  const std::vector<double> times = {0., 0., 0.5, 1., 5.};
  const auto                curve =
    start_up(make_model<dim>(Wi, 0.), R * rates * dealii::transpose(R), times);
  double error = 0.;
  for (unsigned int n = 0; n < times.size(); ++n)
    {
      dealii::Tensor<2, dim> expected;
      for (unsigned int i = 0; i < dim; ++i)
        {
          const double growth = 2. * rates[i][i] - 1. / Wi;
          expected[i][i]      = std::exp(growth * times[n]) +
                           std::expm1(growth * times[n]) / (growth * Wi);
        }
      const dealii::Tensor<2, dim> c = curve[n];
      expected                       = R * expected * dealii::transpose(R);
      error = std::max(error, (c - expected).norm() / c.norm());
    }
  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_most(name + "extension of Oldroyd-B is exact", error, 1e-10);

  dealii::Tensor<2, dim> spin;
  spin[0][1]         = -1.;
  spin[1][0]         = 1.;
  const auto resting = start_up(make_model<dim>(Wi, 0.2), spin, {0., 3.});
  claims.at_most(name + "rotation changes nothing",
                 (resting[1] - dealii::unit_symmetric_tensor<dim>()).norm(),
                 1e-14);
}



bool
times_are_refused(const std::vector<double> &times)
{
  return !Tests::refusal([&]() {
            start_up(make_model<2>(1., 0.1), dealii::Tensor<2, 2>(), times);
          }).empty();
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    compare_with_table<2>(claims);
    compare_with_table<3>(claims);
    compare_with_steady_state<2>(claims);
    compare_with_steady_state<3>(claims);
    compare_with_extension<2>(claims);
    compare_with_extension<3>(claims);
    claims.holds("negative times are refused", times_are_refused({-1.}));
    claims.holds("decreasing times are refused", times_are_refused({2., 1.}));
    claims.holds("infinite times are refused",
                 times_are_refused({std::numeric_limits<double>::infinity()}));
    claims.holds("no times are allowed", !times_are_refused({}));
  });
}

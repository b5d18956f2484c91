// Ds/Dt is the derivative of the logarithm applied to Dc/Dt, to a few
// roundings, whatever the eigenvalues of s; near equilibrium relative to s.

#include <catena/rheology/giesekus.h>

#include "../tests.h"

#include "multiprecision.h"

/// Ds/Dt from Dc/Dt in 100 digits.
template <int dim>
Reference::Matrix<dim>
exact_rate(const Catena::GiesekusParameters      &parameters,
           const dealii::Tensor<2, dim>          &L,
           const dealii::SymmetricTensor<2, dim> &s)
{
  using namespace Reference;
  const auto exact_s   = to_matrix<dim>(s);
  const auto c         = taylor_exponential(exact_s);
  const auto departure = sum(1, c, -1, identity<dim>());
  const auto stretch   = product(to_matrix<dim>(L), c);

  const Number lambda = parameters.weissenberg_number;
  const Number alpha  = parameters.mobility_parameter;

  const auto relaxation =
    sum(-1 / lambda, departure, -alpha / lambda, product(departure, departure));
  const auto rate =
    sum(1, sum(1, stretch, 1, transpose(stretch)), 1, relaxation);
  return derivative<dim>(exact_s, rate, /*of_log=*/true);
}



template <int dim>
void
test(Catena::Tests::Claims &claims)
{
  using namespace Catena;

  std::mt19937                     generator(dim);
  std::normal_distribution<double> normal;
  double exact_error = 0., chain_rule_error = 0., equilibrium_error = 0.;
  for (const double alpha : {0., 0.2, 1.})
    {
      GiesekusParameters parameters;
      parameters.weissenberg_number = 3.;
      parameters.mobility_parameter = alpha;
      const Giesekus<dim> model(parameters);

      for (const auto &s : Reference::hard_cases<dim>(generator))
        {
          dealii::Tensor<2, dim> L;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              L[i][j] = normal(generator);

          const auto              d     = spectral_decomposition(s);
          const auto              g     = model.log_conformation_rate(L, d);
          const auto              exact = exact_rate(parameters, L, s);
          const Reference::Number scale =
            (1. + s.norm()) * (L.norm() + Reference::norm(exact));
          exact_error =
            std::max(exact_error, Reference::roundings(g, exact, scale));

          const auto [low, high] =
            std::minmax_element(d.values.begin(), d.values.end());
          if (*high - *low < 8. && *high < 4.)
            {
              const auto by_chain_rule = logarithm_derivative(
                d, model.conformation_rate(L, exponential(d)));
              chain_rule_error =
                std::max(chain_rule_error,
                         (g - by_chain_rule).norm() / g.norm());
            }

          if (s.norm() > 0. && s.norm() < 0.1)
            {
              const dealii::Tensor<2, dim> rest;
              const auto exact_relaxation = exact_rate(parameters, rest, s);
              equilibrium_error           = std::max(
                equilibrium_error,
                Reference::roundings(model.log_conformation_rate(rest, d),
                                     exact_relaxation,
                                     Reference::norm(exact_relaxation)));
            }
        }
    }

  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_most(name + "the rate of s is exact", exact_error, 16.);
  claims.at_most(name + "the rate of s follows that of c",
                 chain_rule_error,
                 1e-11);
  claims.at_most(name + "relaxation near equilibrium is exact relative to s",
                 equilibrium_error,
                 16.);

  // At equilibrium a rigid rotation changes nothing.
  dealii::Tensor<2, dim> spin;
  spin[0][1]          = -0.5;
  spin[1][0]          = 0.5;
  const double stress = Giesekus<dim>(GiesekusParameters())
                          .stress(dealii::unit_symmetric_tensor<dim>())
                          .norm();
  claims.at_most(name + "there is no stress at equilibrium", stress, 0.);
  claims.at_most(name + "rigid rotation leaves equilibrium",
                 Giesekus<dim>(GiesekusParameters())
                   .log_conformation_rate(spin,
                                          spectral_decomposition(
                                            dealii::SymmetricTensor<2, dim>()))
                   .norm(),
                 1e-16);
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    test<2>(claims);
    test<3>(claims);
  });
}

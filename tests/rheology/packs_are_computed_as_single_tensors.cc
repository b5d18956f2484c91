// The functions of tensors give for packs what they give one by one, to some
// roundings, also where the lanes of a pack take different branches.

#include <catena/rheology/giesekus.h>

#include "../tests.h"

#include "multiprecision.h"

/// The largest difference of a lane from its own result, against @p scale.
template <int dim>
double
difference(
  const dealii::SymmetricTensor<2, dim, Catena::Pack>                  &pack,
  const std::array<dealii::SymmetricTensor<2, dim>, Catena::pack_size> &single,
  const std::array<double, Catena::pack_size>                          &scale)
{
  double largest = 0.;
  for (unsigned int k = 0; k < Catena::pack_size; ++k)
    largest =
      std::max(largest, (Catena::lane(pack, k) - single[k]).norm() / scale[k]);
  return largest;
}



template <int dim>
void
test(Catena::Tests::Claims &claims)
{
  using namespace Catena;
  using Tensor = dealii::SymmetricTensor<2, dim>;

  GiesekusParameters parameters;
  parameters.mobility_parameter = 0.2;
  const Giesekus<dim>              model(parameters);
  std::mt19937                     generator(dim);
  std::normal_distribution<double> normal;

  // of very different sizes side by side
  auto cases = Reference::hard_cases<dim>(generator);
  std::shuffle(cases.begin(), cases.end(), generator);

  double composed = 0., exponentials = 0., exponential_derivatives = 0.,
         logarithm_derivatives = 0., rates = 0., log_rates = 0.,
         relaxations = 0., times = 0.;
  for (unsigned int first = 0; first + pack_size <= cases.size();
       first += pack_size)
    {
      dealii::SymmetricTensor<2, dim, Pack>         s, h;
      dealii::Tensor<2, dim, Pack>                  L;
      Pack                                          crossing;
      std::array<Tensor, pack_size>                 directions;
      std::array<dealii::Tensor<2, dim>, pack_size> gradients;
      for (unsigned int k = 0; k < pack_size; ++k)
        {
          directions[k] = Reference::random_symmetric<dim>(generator);
          set_lane(s, k, cases[first + k]);
          set_lane(h, k, directions[k]);
          crossing[k] = std::abs(normal(generator));
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              L[i][j][k] = gradients[k][i][j] = normal(generator);
        }

      const auto                    spectra = spectral_decomposition(s);
      const auto                    c       = exponential(spectra);
      std::array<Tensor, pack_size> tensors, c_k, dc, ds, rate, log_rate;
      std::array<double, pack_size> size, size_c, size_dc, size_ds, size_rate,
        size_log_rate;
      for (unsigned int k = 0; k < pack_size; ++k)
        {
          const double epsilon = std::numeric_limits<double>::epsilon();
          tensors[k]           = cases[first + k];
          const auto d         = spectral_decomposition(tensors[k]);
          const auto [low, high] =
            std::minmax_element(d.values.begin(), d.values.end());
          const double condition = epsilon * (1. + tensors[k].norm());

          c_k[k]      = exponential(d);
          dc[k]       = exponential_derivative(d, directions[k]);
          ds[k]       = logarithm_derivative(d, directions[k]);
          rate[k]     = model.conformation_rate(gradients[k], lane(c, k));
          log_rate[k] = model.log_conformation_rate(gradients[k], d);

          size[k]    = epsilon * (tensors[k].norm() + 1e-300);
          size_c[k]  = condition * c_k[k].norm();
          size_dc[k] = condition * std::exp(*high) * directions[k].norm();
          size_ds[k] = condition * std::exp(-*low) * directions[k].norm();
          const double c_norm = 1. + c_k[k].norm();
          size_rate[k] = epsilon * c_norm * (c_norm + gradients[k].norm());
          size_log_rate[k] =
            condition * (gradients[k].norm() + log_rate[k].norm());

          relaxations = std::max(relaxations,
                                 std::abs(model.fastest_relaxation(spectra)[k] /
                                            model.fastest_relaxation(d) -
                                          1.) /
                                   condition);
          const double time =
            model.time_of_change(gradients[k], double(crossing[k]));
          times = std::max(times,
                           std::abs(
                             model.time_of_change(L, crossing)[k] / time - 1.) /
                             epsilon);
        }
      composed =
        std::max(composed, difference(compose(spectra), tensors, size));
      exponentials = std::max(exponentials, difference(c, c_k, size_c));
      exponential_derivatives =
        std::max(exponential_derivatives,
                 difference(exponential_derivative(spectra, h), dc, size_dc));
      logarithm_derivatives =
        std::max(logarithm_derivatives,
                 difference(logarithm_derivative(spectra, h), ds, size_ds));
      rates =
        std::max(rates,
                 difference(model.conformation_rate(L, c), rate, size_rate));
      log_rates = std::max(log_rates,
                           difference(model.log_conformation_rate(L, spectra),
                                      log_rate,
                                      size_log_rate));
    }

  // in roundings
  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_most(name + "compose", composed, 16.);
  claims.at_most(name + "exponential", exponentials, 16.);
  claims.at_most(name + "exponential_derivative", exponential_derivatives, 32.);
  claims.at_most(name + "logarithm_derivative", logarithm_derivatives, 32.);
  claims.at_most(name + "conformation_rate", rates, 16.);
  claims.at_most(name + "log_conformation_rate", log_rates, 32.);
  claims.at_most(name + "fastest_relaxation", relaxations, 16.);
  claims.at_most(name + "time_of_change", times, 16.);
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    test<2>(claims);
    test<3>(claims);
  });
}

// exp, log and their derivatives agree with 100-digit arithmetic to a few
// roundings of the data, for equal, close and widely spread eigenvalues.

#include <catena/base/exceptions.h>
#include <catena/rheology/exponential.h>
#include <catena/rheology/spectral.h>

#include "../tests.h"

#include "multiprecision.h"

/// The derivative of exp at s in direction h is the upper right block of the
/// exponential of (s h; 0 s).
template <int dim>
Reference::Matrix<dim>
derivative_by_blocks(const Reference::Matrix<dim> &s,
                     const Reference::Matrix<dim> &h)
{
  Reference::Matrix<2 * dim> block{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      {
        block[i][j] = block[dim + i][dim + j] = s[i][j];
        block[i][dim + j]                     = h[i][j];
      }
  block = Reference::taylor_exponential(block);

  Reference::Matrix<dim> result;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      result[i][j] = block[i][dim + j];
  return result;
}



template <int dim>
bool
logarithm_is_refused(const dealii::SymmetricTensor<2, dim> &c)
{
  try
    {
      Catena::logarithm(c);
    }
  catch (const Catena::SolverError &)
    {
      return true;
    }
  return false;
}



template <int dim>
void
test(Catena::Tests::Claims &claims)
{
  using namespace Catena;

  std::mt19937 generator(dim);
  double       exponential_error = 0., exponentials_error = 0.,
         derivatives_error = 0., logarithm_error = 0., round_trip = 0.,
         near_identity = 0., derivative_error = 0., inverse_error = 0.,
         reference_error = 0.;
  dealii::SymmetricTensor<2, dim, Pack> pack, directions;
  unsigned int                          n_lane = 0;
  for (const auto &s : Reference::hard_cases<dim>(generator))
    {
      const SpectralDecomposition<dim> d = spectral_decomposition(s);
      const Reference::Number condition  = 1. + s.norm(); // of exp, relative
      const auto              exact_s    = Reference::to_matrix<dim>(s);
      const auto              exact_c = Reference::taylor_exponential(exact_s);

      const auto c      = exponential(d);
      exponential_error = std::max(
        exponential_error,
        Reference::roundings(c, exact_c, condition * Reference::norm(exact_c)));

      // in one lane after the other, between those of the cases before
      n_lane = (n_lane + 1) % pack_size;
      set_lane(pack, n_lane, s);
      exponentials_error =
        std::max(exponentials_error,
                 Reference::roundings(lane(exponential(pack), n_lane),
                                      exact_c,
                                      condition * Reference::norm(exact_c)));

      const auto [low, high] =
        std::minmax_element(d.values.begin(), d.values.end());
      const auto exact_log =
        Reference::logarithm<dim>(Reference::to_matrix<dim>(c));
      const Reference::Number spread = std::exp(*high - *low);
      logarithm_error                = std::max(logarithm_error,
                                 Reference::roundings(logarithm(c),
                                                      exact_log,
                                                      spread + s.norm()));

      // An error e |c| in c becomes one of e |c| exp(-low) in log(c).
      round_trip =
        std::max(round_trip,
                 Reference::roundings(logarithm(c),
                                      exact_s,
                                      condition * c.norm() * std::exp(-*low)));

      if (s.norm() < 0.4)
        near_identity =
          std::max(near_identity,
                   Reference::roundings(logarithm(c),
                                        exact_log,
                                        Reference::norm(exact_log) + 1e-300));

      const auto h       = Reference::random_symmetric<dim>(generator);
      const auto exact_h = Reference::to_matrix<dim>(h);
      const auto forward = derivative_by_blocks<dim>(exact_s, exact_h);
      const auto inverse =
        Reference::derivative<dim>(exact_s, exact_h, /*of_log=*/true);
      derivative_error =
        std::max(derivative_error,
                 Reference::roundings(exponential_derivative(d, h),
                                      forward,
                                      condition * std::exp(*high) * h.norm()));
      set_lane(directions, n_lane, h);
      const auto both = exponential(pack, directions);
      exponentials_error =
        std::max(exponentials_error,
                 Reference::roundings(lane(both.value, n_lane),
                                      exact_c,
                                      condition * Reference::norm(exact_c)));
      derivatives_error =
        std::max(derivatives_error,
                 Reference::roundings(lane(both.derivative, n_lane),
                                      forward,
                                      condition * std::exp(*high) * h.norm()));
      inverse_error =
        std::max(inverse_error,
                 Reference::roundings(logarithm_derivative(d, h),
                                      inverse,
                                      condition * std::exp(-*low) * h.norm()));

      // The two ways to the reference agree far beyond double precision.
      const auto difference = Reference::sum(
        1, Reference::derivative<dim>(exact_s, exact_h, false), -1, forward);
      reference_error =
        std::max(reference_error,
                 static_cast<double>(Reference::norm(difference) /
                                     Reference::norm(forward)));
    }

  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_most(name + "exp is exact", exponential_error, 8.);
  claims.at_most(name + "exp without a spectrum is exact",
                 exponentials_error,
                 16.);
  claims.at_most(name + "log is exact", logarithm_error, 8.);
  claims.at_most(name + "log inverts exp", round_trip, 8.);
  claims.at_most(name + "log is exact relative to c - I", near_identity, 16.);
  claims.at_most(name + "the derivative of exp is exact",
                 derivative_error,
                 16.);
  claims.at_most(name + "that without a spectrum is exact",
                 derivatives_error,
                 16.);
  claims.at_most(name + "the derivative of log is exact", inverse_error, 16.);
  claims.at_most(name + "the references agree", reference_error, 1e-30);

  // two lanes without a result do not disturb the others
  for (unsigned int k = 0; k < pack_size; ++k)
    set_lane(pack, k, Reference::random_symmetric<dim>(generator));
  const auto harmless = exponential(pack);
  pack[0][1][0]       = std::numeric_limits<double>::infinity();
  pack[0][0][2]       = 1e6;
  const auto harmful  = exponential(pack);
  for (unsigned int k = 0; k < pack_size; ++k)
    if (k == 0 || k == 2)
      claims.holds(name + "what has no exponential gives none",
                   !std::isfinite(lane(harmful, k).norm()));
    else
      claims.at_most(name + "it does not disturb the others",
                     (lane(harmful, k) - lane(harmless, k)).norm(),
                     0.);

  auto c  = dealii::unit_symmetric_tensor<dim, double>();
  c[0][1] = 1.;
  claims.holds(name + "a singular tensor has no logarithm",
               logarithm_is_refused(c));
  c[0][1] = 1.5;
  claims.holds(name + "an indefinite tensor has no logarithm",
               logarithm_is_refused(c));
  c[0][1] = std::numeric_limits<double>::quiet_NaN();
  claims.holds(name + "not a number has no logarithm", logarithm_is_refused(c));
  c[0][1] = std::numeric_limits<double>::infinity();
  claims.holds(name + "infinity has no logarithm", logarithm_is_refused(c));
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    test<2>(claims);
    test<3>(claims);
  });
}

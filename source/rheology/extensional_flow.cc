#include <catena/base/exceptions.h>
#include <catena/rheology/extensional_flow.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * A component c of the conformation in a principal direction of the flow,
     * and q = (c - 1)/k.
     */
    struct Stretch
    {
      double conformation;
      double quotient;
    };



    /**
     * The root of k c = (c - 1) + alpha (c - 1)^2, if there is one.
     *
     * With d = (1 - k)^2 + 4 alpha k, which is (1 + k)^2 - 4 (1 - alpha) k as
     * well, it is c - 1 = 2 k/((1 - k) + sqrt(d)) and
     * c = 2 (1 - alpha)/((1 - k - 2 alpha) + sqrt(d)). Chosen are the forms in
     * which no positive numbers are subtracted.
     */
    std::optional<Stretch>
    stretch(const double k, const double alpha)
    {
      if (alpha == 0. && k >= 1.)
        return {};

      const double d    = k > 0. ? (1. - k) * (1. - k) + 4. * alpha * k :
                                   (1. + k) * (1. + k) - 4. * (1. - alpha) * k;
      const double root = std::sqrt(d);

      Stretch result;
      result.quotient =
        k < 1. ? 2. / ((1. - k) + root) : ((k - 1.) + root) / (2. * alpha * k);

      if (k > 0.)
        {
          result.conformation = 1. + k * result.quotient;
          return result;
        }
      const double b = (1. - alpha) - (k + alpha);
      if (b < 0.)
        result.conformation = (root - b) / (2. * alpha);
      else // with alpha = 1 and k = -1 the root is 0
        result.conformation =
          (b + root > 0. ? 2. * (1. - alpha) / (b + root) : 0.);
      return result;
    }
  } // namespace



  Tensor<2, 3>
  uniaxial_extension(const double rate)
  {
    Tensor<2, 3> L;
    L[0][0] = rate;
    L[1][1] = L[2][2] = -0.5 * rate;
    return L;
  }



  SymmetricTensor<2, 3>
  SteadyExtension::conformation() const
  {
    SymmetricTensor<2, 3> c;
    c[0][0] = axial_conformation;
    c[1][1] = c[2][2] = radial_conformation;
    return c;
  }



  std::optional<SteadyExtension>
  steady_extension(const GiesekusParameters &parameters, const double rate)
  {
    parameters.check();
    require(std::isfinite(rate), "rate", rate, "must be finite.");

    const double Wi    = parameters.weissenberg_number * rate;
    const double alpha = parameters.mobility_parameter;
    const double beta  = parameters.solvent_viscosity_ratio;

    const std::optional<Stretch> axial  = stretch(2. * Wi, alpha);
    const std::optional<Stretch> radial = stretch(-Wi, alpha);
    if (!axial || !radial)
      return {};

    SteadyExtension state;
    state.viscosity =
      3. * beta + (1. - beta) * (2. * axial->quotient + radial->quotient);
    state.axial_conformation  = axial->conformation;
    state.radial_conformation = radial->conformation;
    return state;
  }
} // namespace Catena

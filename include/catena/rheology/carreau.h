#ifndef catena_rheology_carreau_h
#define catena_rheology_carreau_h

#include <deal.II/base/parameter_handler.h>

#include <cmath>

namespace Catena
{
  /**
   * The dimensionless groups of a Carreau fluid whose viscosity at high rates
   * goes to zero. Lengths are in a, rates in gamma, viscosities in eta0.
   */
  struct CarreauParameters
  {
    /// lambda_c gamma, the time that sets the rate at which the viscosity
    /// begins to change, in units of 1/gamma; lambda_c gamma >= 0.
    double carreau_time = 1.;

    /// n, 0 < n <= 2: the viscosity falls (n < 1) or grows (n > 1) as
    /// g^(n-1) at high rates g; n = 1 is the Newtonian fluid.
    double power_index = 0.5;

    /**
     * Declare the entries "Carreau time" and "Power index" in the current
     * section of @p prm. Parsing @p prm fills this object, which must outlive
     * @p prm.
     */
    void
    declare(dealii::ParameterHandler &prm);

    /**
     * @throws InputError if a parameter is outside its range.
     */
    void
    check() const;
  };

  /**
   * The Carreau model (P.J. Carreau, Trans. Soc. Rheol. 16 (1972) 99; Bird,
   * Armstrong & Hassager, Dynamics of Polymeric Liquids, volume 1, section
   * 4.1) at a material point. The stress is
   * @f[
   *   \sigma = -p I + 2 \eta(g) D, \qquad
   *   \eta(g) = \left[ 1 + (\lambda_c g)^2 \right]^{(n-1)/2}, \qquad
   *   g = \sqrt{2 D : D}
   * @f]
   * with D the rate of strain. Rates are in units of gamma, viscosities in
   * units of eta0. The functions take the square of the rate, g^2 = 2 D:D,
   * in which the viscosity is smooth also at rest.
   */
  class Carreau
  {
  public:
    /**
     * @throws InputError as CarreauParameters::check() does.
     */
    explicit Carreau(const CarreauParameters &parameters);

    /**
     * eta at @p rate_squared = g^2 >= 0, in units of eta0.
     */
    double
    viscosity(const double rate_squared) const;

    /**
     * d eta/d(g^2) at @p rate_squared = g^2 >= 0, in units of eta0/gamma^2:
     * @f[
     *   \frac{d\eta}{d(g^2)} = \frac{n-1}{2} \lambda_c^2
     *     \left[ 1 + (\lambda_c g)^2 \right]^{(n-3)/2}.
     * @f]
     * As d(g^2) = 4 D:dD, the change of the stress with the rate of strain is
     * d(2 eta D) = 2 eta dD + 8 (d eta/d(g^2)) (D:dD) D.
     */
    double
    viscosity_derivative(const double rate_squared) const;

  private:
    double time_squared; // lambda_c^2
    double exponent;     // (n - 1)/2
  };



  // ---------------------------- inline functions ----------------------------

  inline double
  Carreau::viscosity(const double rate_squared) const
  {
    return std::pow(1. + time_squared * rate_squared, exponent);
  }



  inline double
  Carreau::viscosity_derivative(const double rate_squared) const
  {
    return exponent * time_squared *
           std::pow(1. + time_squared * rate_squared, exponent - 1.);
  }
} // namespace Catena

#endif

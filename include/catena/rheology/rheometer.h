#ifndef catena_rheology_rheometer_h
#define catena_rheology_rheometer_h

#include <catena/rheology/fluid_parameters.h>

#include <optional>
#include <vector>

namespace Catena
{
  /**
   * The stress in the simple shear u_x = +rate y, steady or starting up. For
   * u_x = -rate y the shear stress and S change sign and nothing else does.
   */
  struct ShearFunctions
  {
    /// eta = sigma_xy/rate, in units of eta0.
    double viscosity;

    /// N1 = sigma_xx - sigma_yy, in units of eta0 gamma.
    double first_normal_stress_difference;

    /// N2 = sigma_yy - sigma_zz, in units of eta0 gamma.
    double second_normal_stress_difference;

    /// S = N1/(2 sigma_xy).
    double elasticity_parameter;
  };

  /**
   * The material functions of a fluid, exact and without any mesh (definitions:
   * Bird, Armstrong & Hassager, Dynamics of Polymeric Liquids, volume 1,
   * chapter 3). Rates are in units of gamma, times in units of 1/gamma,
   * viscosities in units of eta0, stresses in units of eta0 gamma; viscosity
   * and stress include the solvent. Start-up is from rest, c = I, without
   * inertia.
   *
   * In Newtonian and Carreau fluids the stress follows the rate at once, N1 =
   * N2 = 0, and in uniaxial extension, where g = sqrt(3) rate,
   * @f[
   *   \eta_E(\dot\varepsilon) = 3\, \eta(\sqrt{3}\, \dot\varepsilon).
   * @f]
   */
  class Rheometer
  {
  public:
    /**
     * @throws InputError as FluidParameters::check() does.
     */
    explicit Rheometer(const FluidParameters &fluid);

    /**
     * lambda times @p rate; 0 for a fluid without elasticity.
     */
    double
    weissenberg_number(const double rate) const;

    /**
     * Steady simple shear at @p rate > 0, see steady_shear().
     *
     * @throws InputError if the rate cannot be used.
     */
    ShearFunctions
    steady_shear(const double rate) const;

    /**
     * Simple shear at @p rate > 0 from rest: the functions at each of
     * @p times, see start_up().
     *
     * @throws InputError if the rate, or in an elastic fluid a time, cannot be
     * used.
     * @throws SolverError if the result is not finite.
     */
    std::vector<ShearFunctions>
    start_up_shear(const double rate, const std::vector<double> &times) const;

    /**
     * The viscosity eta_E of steady uniaxial extension at @p rate > 0, see
     * steady_extension(); no value where there is no steady state.
     *
     * @throws InputError if the rate cannot be used.
     */
    std::optional<double>
    steady_extension(const double rate) const;

    /**
     * Uniaxial extension at @p rate > 0 from rest: (sigma_xx - sigma_yy)/rate
     * at each of @p times, see start_up().
     *
     * @throws InputError if the rate, or in an elastic fluid a time, cannot be
     * used.
     * @throws SolverError if the result is not finite.
     */
    std::vector<double>
    start_up_extension(const double               rate,
                       const std::vector<double> &times) const;

  private:
    FluidParameters fluid;

    bool
    is_elastic() const;

    /// eta at g = sqrt(2 D:D) of a fluid without elasticity, for g^2.
    double
    inelastic_viscosity(const double rate_squared) const;
  };
} // namespace Catena

#endif

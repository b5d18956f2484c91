#ifndef catena_rheology_shear_flow_h
#define catena_rheology_shear_flow_h

#include <catena/rheology/giesekus.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Catena
{
  /**
   * The steady state of a Giesekus fluid in the simple shear u_x = +gamma y.
   * For u_x = -gamma y the shear stress and c_xy change sign and nothing else
   * does.
   */
  struct SteadyShear
  {
    /// eta = sigma_xy/gamma, solvent included, in units of eta0.
    double viscosity;

    /// tau_xy/G = c_xy, the shear stress of the polymer.
    double shear_stress;

    /// N1/G = c_xx - c_yy.
    double first_normal_stress_difference;

    /// N2/G = c_yy - c_zz; c_zz = 1.
    double second_normal_stress_difference;

    /// S = N1/(2 sigma_xy), solvent included.
    double elasticity_parameter;

    /**
     * The conformation c, for u_x = +gamma y.
     */
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    conformation() const;
  };

  /**
   * Steady simple shear in closed form (H. Giesekus, J. Non-Newtonian Fluid
   * Mech. 11 (1982) 69; Bird, Armstrong & Hassager, Dynamics of Polymeric
   * Liquids, volume 1, section 7.3):
   * @f[
   *   \Lambda^2 = \frac{2}{1 + \sqrt{1 + 16 \alpha (1-\alpha) Wi^2}}, \quad
   *   f = \frac{1 - \Lambda}{1 + (1 - 2\alpha) \Lambda}, \quad
   *   \frac{\tau_{xy}}{G} = \frac{Wi (1-f)^2}{1 + (1-2\alpha) f}, \quad
   *   \frac{N_1}{G} = \frac{2 f (1 - \alpha f)}{\alpha (1 - f)}, \quad
   *   \frac{N_2}{G} = -f,
   * @f]
   * evaluated in a form that loses no digits for small Wi and for alpha near
   * 0 or 1, and that is exact for the Oldroyd-B fluid (alpha = 0), where
   * N1/G = 2 Wi^2 and S = (1 - beta) Wi.
   *
   * @throws InputError as GiesekusParameters::check() does.
   */
  SteadyShear
  steady_shear(const GiesekusParameters &parameters);

  /**
   * The conformation c at each of @p times (in units of 1/gamma, not
   * decreasing and not negative) in a homogeneous flow with the constant
   * velocity gradient @p L that starts at time 0 from rest, c = I.
   *
   * Ds/Dt = Giesekus::log_conformation_rate() is integrated by the embedded
   * Runge-Kutta-Fehlberg method of order 8(7), with an error of 1e-12 a step
   * in s, or 1e-12 lambda |L| if that is less; over tens of relaxation times
   * c = exp(s) is right to about 1e-11.
   *
   * @throws InputError if @p times cannot be used.
   * @throws SolverError if the result is not finite.
   */
  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>>
  start_up(const Giesekus<dim>          &model,
           const dealii::Tensor<2, dim> &L,
           const std::vector<double>    &times);
} // namespace Catena

#endif

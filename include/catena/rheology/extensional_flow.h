#ifndef catena_rheology_extensional_flow_h
#define catena_rheology_extensional_flow_h

#include <catena/rheology/giesekus.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <optional>

namespace Catena
{
  /**
   * The velocity gradient diag(1, -1/2, -1/2) @p rate of uniaxial extension
   * along x, in the units of @p rate. A negative rate is biaxial extension.
   */
  dealii::Tensor<2, 3>
  uniaxial_extension(const double rate);

  /**
   * The steady state of a Giesekus fluid in the flow of uniaxial_extension().
   */
  struct SteadyExtension
  {
    /// eta_E = (sigma_xx - sigma_yy)/rate, solvent included, in units of eta0.
    double viscosity;

    /// c_xx along the axis.
    double axial_conformation;

    /// c_yy = c_zz across the axis.
    double radial_conformation;

    dealii::SymmetricTensor<2, 3>
    conformation() const;
  };

  /**
   * Steady uniaxial extension at @p rate, in units of gamma, in closed form.
   * The components of the conformation along and across the axis are
   * independent of each other (Bird, Armstrong & Hassager, Dynamics of
   * Polymeric Liquids, volume 1, section 7.3): each is the positive root of
   * @f[
   *   k c = (c - 1) + \alpha (c - 1)^2, \qquad
   *   k = \begin{cases} 2 \lambda \dot\varepsilon & \text{for } c_{xx} \\
   *       -\lambda \dot\varepsilon & \text{for } c_{yy} = c_{zz} \end{cases}
   * @f]
   * that is 1 at rest, and
   * @f[
   *   \frac{\eta_E}{\eta_0} = 3 \beta + (1-\beta)
   *     \frac{c_{xx} - c_{yy}}{\lambda \dot\varepsilon},
   * @f]
   * evaluated in a form that loses no digits for small and large rates and
   * for alpha near 0 or 1. It goes from 3 at rest to 3 beta + 2 (1 -
   * beta)/alpha in strong extension.
   *
   * For the Oldroyd-B fluid (alpha = 0) c = 1/(1 - k).
   *
   * @return No value where there is no steady state, as the conformation grows
   *   for ever: in the Oldroyd-B fluid at Wi rate >= 1/2 (and, for biaxial
   *   extension, Wi rate <= -1).
   * @throws InputError as GiesekusParameters::check() does, and for a rate
   *   that is not finite.
   */
  std::optional<SteadyExtension>
  steady_extension(const GiesekusParameters &parameters, const double rate);
} // namespace Catena

#endif

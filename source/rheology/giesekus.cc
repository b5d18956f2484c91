#include <catena/base/exceptions.h>
#include <catena/rheology/giesekus.h>

#include <deal.II/base/patterns.h>

namespace Catena
{
  using namespace dealii;

  void
  GiesekusParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Weissenberg number",
                      weissenberg_number,
                      "Wi = lambda gamma: the relaxation time in units of "
                      "1/gamma, with gamma the imposed shear rate. Wi > 0.",
                      Patterns::Double());
    prm.add_parameter("Mobility parameter",
                      mobility_parameter,
                      "alpha of the Giesekus model, without unit, from 0 "
                      "(Oldroyd-B: no shear thinning) to 1.",
                      Patterns::Double());
    prm.add_parameter("Solvent viscosity ratio",
                      solvent_viscosity_ratio,
                      "beta = eta_s/eta0: the solvent's part of the viscosity "
                      "at zero shear rate, eta0 = eta_s + eta_p, from 0 (no "
                      "solvent) to less than 1.",
                      Patterns::Double());
  }



  void
  GiesekusParameters::check() const
  {
    require(weissenberg_number > 0. && std::isfinite(weissenberg_number),
            "Weissenberg number",
            weissenberg_number,
            "must be positive and finite; for a fluid without elasticity "
            "choose 'Fluid/Model' = newtonian.");
    require(mobility_parameter >= 0. && mobility_parameter <= 1.,
            "Mobility parameter",
            mobility_parameter,
            "must lie between 0 (Oldroyd-B) and 1.");
    require(solvent_viscosity_ratio >= 0. && solvent_viscosity_ratio <= 1.,
            "Solvent viscosity ratio",
            solvent_viscosity_ratio,
            "must be at least 0 (no solvent) and less than 1.");
    require(solvent_viscosity_ratio < 1.,
            "Solvent viscosity ratio",
            solvent_viscosity_ratio,
            "the solvent is all of the viscosity and no polymer is left; "
            "choose 'Fluid/Model' = newtonian.");
  }



  template <int dim>
  Giesekus<dim>::Giesekus(const GiesekusParameters &parameters)
    : lambda(parameters.weissenberg_number)
    , alpha(parameters.mobility_parameter)
    , beta(parameters.solvent_viscosity_ratio)
  {
    parameters.check();
  }



  template class Giesekus<2>;
  template class Giesekus<3>;
} // namespace Catena

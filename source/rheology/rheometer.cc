#include <catena/base/exceptions.h>
#include <catena/rheology/extensional_flow.h>
#include <catena/rheology/rheometer.h>
#include <catena/rheology/shear_flow.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    void
    check_rate(const double rate)
    {
      require(rate > 0. && std::isfinite(rate),
              "rate",
              rate,
              "must be positive and finite.");
    }



    /**
     * The functions for the conformation @p c, sheared at @p rate.
     */
    ShearFunctions
    shear_functions(const Giesekus<3>           &model,
                    const SymmetricTensor<2, 3> &c,
                    const double                 rate)
    {
      const SymmetricTensor<2, 3> tau = model.stress(c);
      const double shear_stress = model.solvent_viscosity() * rate + tau[0][1];

      ShearFunctions result;
      result.viscosity                       = shear_stress / rate;
      result.first_normal_stress_difference  = tau[0][0] - tau[1][1];
      result.second_normal_stress_difference = tau[1][1] - tau[2][2];
      // At rest there may be no stress to divide by, and S = 0.
      result.elasticity_parameter =
        result.first_normal_stress_difference == 0. ?
          0. :
          result.first_normal_stress_difference / (2. * shear_stress);
      return result;
    }
  } // namespace



  Rheometer::Rheometer(const FluidParameters &fluid)
    : fluid(fluid)
  {
    fluid.check();
  }



  double
  Rheometer::weissenberg_number(const double rate) const
  {
    return is_elastic() ? fluid.giesekus.weissenberg_number * rate : 0.;
  }



  ShearFunctions
  Rheometer::steady_shear(const double rate) const
  {
    check_rate(rate);
    if (!is_elastic())
      return {inelastic_viscosity(rate * rate), 0., 0., 0.};

    GiesekusParameters at_rate = fluid.giesekus;
    at_rate.weissenberg_number *= rate;
    const SteadyShear state   = Catena::steady_shear(at_rate);
    const double      modulus = Giesekus<3>(fluid.giesekus).modulus();
    return {state.viscosity,
            modulus * state.first_normal_stress_difference,
            modulus * state.second_normal_stress_difference,
            state.elasticity_parameter};
  }



  std::vector<ShearFunctions>
  Rheometer::start_up_shear(const double               rate,
                            const std::vector<double> &times) const
  {
    if (!is_elastic())
      return std::vector<ShearFunctions>(times.size(), steady_shear(rate));

    check_rate(rate);
    Tensor<2, 3> L;
    L[0][1] = rate;

    const Giesekus<3>           model(fluid.giesekus);
    std::vector<ShearFunctions> result;
    for (const SymmetricTensor<2, 3> &c : start_up(model, L, times))
      result.push_back(shear_functions(model, c, rate));
    return result;
  }



  std::optional<double>
  Rheometer::steady_extension(const double rate) const
  {
    check_rate(rate);
    if (!is_elastic())
      return 3. * inelastic_viscosity(3. * rate * rate);

    const auto state = Catena::steady_extension(fluid.giesekus, rate);
    if (!state)
      return {};
    return state->viscosity;
  }



  std::vector<double>
  Rheometer::start_up_extension(const double               rate,
                                const std::vector<double> &times) const
  {
    if (!is_elastic())
      return std::vector<double>(times.size(), *steady_extension(rate));

    check_rate(rate);
    const Giesekus<3>   model(fluid.giesekus);
    std::vector<double> result;
    for (const SymmetricTensor<2, 3> &c :
         start_up(model, uniaxial_extension(rate), times))
      result.push_back(3. * model.solvent_viscosity() +
                       model.modulus() * (c[0][0] - c[1][1]) / rate);
    return result;
  }



  bool
  Rheometer::is_elastic() const
  {
    return fluid.model == FluidParameters::Model::giesekus;
  }



  double
  Rheometer::inelastic_viscosity(const double rate_squared) const
  {
    return fluid.model == FluidParameters::Model::carreau ?
             Carreau(fluid.carreau).viscosity(rate_squared) :
             1.;
  }
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/rheology/carreau.h>

#include <deal.II/base/patterns.h>

namespace Catena
{
  using namespace dealii;

  void
  CarreauParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Carreau time",
                      carreau_time,
                      "lambda_c gamma of the Carreau model: the viscosity "
                      "begins to change at the rate 1/lambda_c; in units of "
                      "1/gamma, with gamma the imposed shear rate. Not "
                      "negative.",
                      Patterns::Double());
    prm.add_parameter("Power index",
                      power_index,
                      "n of the Carreau model, without unit: at high rates "
                      "the viscosity goes as rate^(n-1). Positive and at most "
                      "2; 1 is the Newtonian fluid.",
                      Patterns::Double());
  }



  void
  CarreauParameters::check() const
  {
    require(carreau_time >= 0. && std::isfinite(carreau_time),
            "Carreau time",
            carreau_time,
            "must be finite and not negative.");
    require(power_index > 0. && power_index <= 2.,
            "Power index",
            power_index,
            "must be positive and at most 2; less than 1 thins with the rate.");
  }



  Carreau::Carreau(const CarreauParameters &parameters)
    : time_squared(parameters.carreau_time * parameters.carreau_time)
    , exponent(0.5 * (parameters.power_index - 1.))
  {
    parameters.check();
  }
} // namespace Catena

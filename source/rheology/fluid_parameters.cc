#include <catena/rheology/fluid_parameters.h>

#include <deal.II/base/patterns.h>

namespace Catena
{
  using namespace dealii;

  void
  FluidParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Model",
                      "giesekus",
                      Patterns::Selection("newtonian|carreau|giesekus"),
                      "newtonian, carreau, or giesekus (Oldroyd-B with a "
                      "mobility of 0).");
    prm.add_action("Model", [this](const std::string &name) {
      model = (name == "newtonian" ? Model::newtonian :
               name == "carreau"   ? Model::carreau :
                                     Model::giesekus);
    });
    giesekus.declare(prm);
    carreau.declare(prm);
  }



  void
  FluidParameters::check() const
  {
    if (model == Model::giesekus)
      giesekus.check();
    if (model == Model::carreau)
      carreau.check();
  }
} // namespace Catena

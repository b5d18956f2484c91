#include <catena/rheology/fluid_parameters.h>

#include <deal.II/base/patterns.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    std::string
    name(const FluidParameters::Model model)
    {
      switch (model)
        {
          case FluidParameters::Model::newtonian:
            return "newtonian";
          case FluidParameters::Model::carreau:
            return "carreau";
          default:
            return "giesekus";
        }
    }
  } // namespace



  void
  FluidParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Model",
                      name(model),
                      Patterns::Selection("newtonian|carreau|giesekus"),
                      "newtonian, carreau, or giesekus (Oldroyd-B with a "
                      "mobility of 0).");
    prm.add_action("Model", [this](const std::string &chosen) {
      for (const Model known :
           {Model::newtonian, Model::carreau, Model::giesekus})
        if (name(known) == chosen)
          model = known;
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

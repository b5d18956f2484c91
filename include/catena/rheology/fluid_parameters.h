#ifndef catena_rheology_fluid_parameters_h
#define catena_rheology_fluid_parameters_h

#include <catena/rheology/carreau.h>
#include <catena/rheology/giesekus.h>

#include <deal.II/base/parameter_handler.h>

namespace Catena
{
  /**
   * The choice of a fluid and the parameters of all models; those of the
   * models not chosen have no effect.
   */
  struct FluidParameters
  {
    enum class Model
    {
      /// The viscosity eta0 and nothing else.
      newtonian,
      /// A viscosity that depends on the rate of strain, see Carreau.
      carreau,
      /// A viscoelastic fluid, see Giesekus; Oldroyd-B with a mobility of 0.
      giesekus
    };

    Model              model = Model::giesekus;
    CarreauParameters  carreau;
    GiesekusParameters giesekus;

    /**
     * Declare the entry "Model" and those of the models in the current section
     * of @p prm. Parsing @p prm fills this object, which must outlive @p prm.
     */
    void
    declare(dealii::ParameterHandler &prm);

    /**
     * @throws InputError if a parameter of the chosen model is outside its
     *   range.
     */
    void
    check() const;
  };
} // namespace Catena

#endif

#ifndef catena_scene_one_particle_h
#define catena_scene_one_particle_h

#include <catena/scene/box.h>

namespace Catena
{
  /**
   * A lone particle of radius a at the origin of the quarter of a box that is
   * left by mirror and rotational symmetry: it turns and stays where it is.
   */
  struct OneParticleParameters
  {
    BoxParameters box;

    /// In a subsection `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a box that makes no sense
    void
    check() const;

    template <int dim>
    Scene<dim>
    scene() const;
  };
} // namespace Catena

#endif

#ifndef catena_scene_confined_cylinder_h
#define catena_scene_confined_cylinder_h

#include <catena/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

namespace Catena
{
  /**
   * A fixed cylinder of radius 1 in the middle of a channel, past which the
   * fluid is driven by pressure; in two dimensions. The mean velocity U of the
   * channel away from the cylinder is 1. Lengths in radii R, times in R/U.
   */
  struct ConfinedCylinderParameters
  {
    /// L, period along the channel
    double length = 30.;
    /// 2 H, distance of the walls
    double height = 4.;

    /// In a subsection `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a channel that makes no sense
    void
    check() const;

    /// For dim = 2 only.
    template <int dim = 2>
    Scene<dim>
    scene() const;
  };

  template <>
  Scene<2>
  ConfinedCylinderParameters::scene() const;
} // namespace Catena

#endif

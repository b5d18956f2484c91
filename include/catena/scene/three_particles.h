#ifndef catena_scene_three_particles_h
#define catena_scene_three_particles_h

#include <catena/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

namespace Catena
{
  /**
   * Three equal particles in a line in sheared fluid (Jaensson et al. 2016,
   * section 4): one at the origin, the others at +-distance (cos angle,
   * sin angle). Only the quarter of the box that is left by mirror and
   * rotational symmetry is meshed, with half of the middle particle and the
   * outer one at x > 0 (dim = 2: half of the box, by the rotation alone).
   */
  struct ThreeParticlesParameters
  {
    double length   = 80.; ///< L [a]
    double height   = 40.; ///< H, the distance of the walls [a]
    double width    = 20.; ///< W [a]
    double distance = 3.;  ///< of an outer centre from the middle one [a]
    double angle    = 10.; ///< of the line of centres against x [degrees]

    /// In a subsection `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a box or particles that make no sense
    void
    check() const;

    template <int dim>
    Scene<dim>
    scene() const;
  };
} // namespace Catena

#endif

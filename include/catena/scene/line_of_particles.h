#ifndef catena_scene_line_of_particles_h
#define catena_scene_line_of_particles_h

#include <catena/scene/box.h>

namespace Catena
{
  /**
   * Two or three equal particles in a line in sheared fluid (Jaensson et al.
   * 2016, section 4): two of them at +-distance (cos angle, sin angle), and
   * the third at the origin.
   *
   * Only part of the box need be meshed: the half z >= 0 by mirror symmetry, or
   * the quarter that is left by the rotation of half a turn about z as well,
   * with half of the middle particle and one of the others (dim = 2: half of
   * the box by the rotation alone).
   */
  struct LineOfParticlesParameters
  {
    BoxParameters box;
    Symmetry      symmetry = Symmetry::quarter;
    double        distance;    ///< of an outer centre from the origin [a]
    double        angle = 10.; ///< of the line of centres against x [degrees]

    /// @param n_particles 2 or 3
    explicit LineOfParticlesParameters(const unsigned int n_particles);

    /// In a subsection `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a box or particles that make no sense
    void
    check() const;

    /**
     * The particle in the middle, if there is one, comes first, then the one
     * in the direction of the angle, then the other unless the rotation
     * provides it.
     */
    template <int dim>
    Scene<dim>
    scene() const;

  private:
    unsigned int n_particles;
  };
} // namespace Catena

#endif

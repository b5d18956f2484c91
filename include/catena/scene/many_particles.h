#ifndef catena_scene_many_particles_h
#define catena_scene_many_particles_h

#include <catena/scene/box.h>

#include <vector>

namespace Catena
{
  /**
   * Any number of particles, anywhere in the box or on its mirror plane z = 0:
   * those that are listed, and more at random places.
   */
  struct ManyParticlesParameters
  {
    BoxParameters box;
    Symmetry      symmetry = Symmetry::none;

    /// listed centres [a]
    std::vector<dealii::Point<3>> centres;
    /// radii [a], listed particles first; repeated from the start if there are
    /// more particles than radii
    std::vector<double> radii = {1.};

    /// particles at random places
    unsigned int number = 0;
    /// instead of the number: the share of the box filled by all particles
    double volume_fraction = 0.;
    /// between surfaces at the start, for particles at random places [a]
    double       smallest_distance = 0.2;
    unsigned int seed              = 1;

    ManyParticlesParameters();

    /// In a subsection `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a box or particles that make no sense
    void
    check() const;

    /// @throws InputError if there is no place for so many particles
    template <int dim>
    Scene<dim>
    scene() const;

  private:
    /// Radii of the particles at random places.
    std::vector<double>
    random_radii() const;
  };
} // namespace Catena

#endif

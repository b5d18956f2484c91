#ifndef catena_tests_particles_scenes_h
#define catena_tests_particles_scenes_h

#include <catena/particles/contacts.h>
#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>
#include <catena/scene/scene.h>

#include <string>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    /// d_min of these tests: unit spheres are held 2.04 apart.
    constexpr double minimal_gap   = 0.02;
    constexpr double held_distance = 2. + 2. * minimal_gap;



    template <int dim>
    dealii::Point<dim>
    point(const double x, const double y, const double z = 0.)
    {
      dealii::Point<dim> p;
      p[0] = x;
      p[1] = y;
      if (dim == 3)
        p[dim - 1] = z;
      return p;
    }



    template <int dim>
    Scene<dim>
    scene_of(const Symmetry                    symmetry,
             const std::vector<Particle<dim>> &particles)
    {
      Scene<dim> scene;
      scene.symmetry  = symmetry;
      scene.particles = particles;
      return scene;
    }



    template <int dim>
    Configuration<dim>
    configuration_of(const Scene<dim> &scene)
    {
      Configuration<dim> configuration;
      for (const auto &particle : scene.particles)
        configuration.centres.push_back(particle.centre);
      return configuration;
    }



    template <int dim>
    struct NamedScene
    {
      std::string name;
      Scene<dim>  scene;
    };



    /**
     * Scenes with a pair of surfaces at @p distance of each kind: free
     * particles, across the end of the period, with the own image under the
     * rotation, with a particle on the axis, with the image of another one.
     */
    template <int dim>
    std::vector<NamedScene<dim>>
    pairs_at(const double distance)
    {
      const double c = std::cos(0.3), s = std::sin(0.3);
      const double x = 39.4, half = distance / 2.;
      return {{"free particles",
               scene_of<dim>(Symmetry::none,
                             {{point<dim>(half * c, half * s)},
                              {point<dim>(-half * c, -half * s)}})},
              {"across the end of the period",
               scene_of<dim>(Symmetry::none,
                             {{point<dim>(x, 1.)},
                              {point<dim>(x + distance * c - 80.,
                                          1. + distance * s)}})},
              {"with the own image",
               scene_of<dim>(Symmetry::quarter,
                             {{point<dim>(half * c, half * s)}})},
              {"with a particle on the axis",
               scene_of<dim>(Symmetry::quarter,
                             {{point<dim>(0., 0.), 1., true},
                              {point<dim>(distance * c, distance * s)}})},
              {"with the image of another",
               scene_of<dim>(Symmetry::quarter,
                             {{point<dim>(half * c + 1., half * s + 2.)},
                              {point<dim>(half * c - 1., half * s - 2.)}})}};
    }



    /**
     * The scene without its symmetries: all images are particles, those of the
     * scene the first.
     */
    template <int dim>
    Scene<dim>
    whole_box(const Scene<dim> &scene)
    {
      Scene<dim> whole = scene;
      whole.symmetry   = Symmetry::none;
      for (Particle<dim> &particle : whole.particles)
        particle.on_axis = false;
      if (scene.rotational())
        for (const Particle<dim> &particle : scene.particles)
          if (!particle.on_axis)
            {
              Particle<dim> image = particle;
              image.centre[0] *= -1.;
              image.centre[1] *= -1.;
              whole.particles.push_back(image);
            }
      if (scene.mirrored())
        for (unsigned int i = 0, n = whole.particles.size(); i < n; ++i)
          if (whole.particles[i].centre[dim - 1] != 0.)
            {
              Particle<dim> image = whole.particles[i];
              image.centre[dim - 1] *= -1.;
              whole.particles.push_back(image);
            }
      return whole;
    }
  } // namespace Tests
} // namespace Catena

#endif

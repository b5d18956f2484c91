// Particles at random places keep their distance, are the same for the same
// seed, and are refused when there is no place for them.

#include <catena/base/exceptions.h>
#include <catena/scene/many_particles.h>

#include "../tests.h"

#include "../refusal.h"

using namespace dealii;
using namespace Catena;



ManyParticlesParameters
crowd(const Symmetry symmetry, const unsigned int seed)
{
  ManyParticlesParameters parameters;
  parameters.symmetry   = symmetry;
  parameters.box.length = 14.;
  parameters.box.height = 12.;
  parameters.box.width  = 10.;
  parameters.centres    = {Point<3>(1., 2., 0.)};
  parameters.radii      = {1., 0.6, 0.8};
  parameters.number     = symmetry == Symmetry::none ? 30 : 12;
  parameters.seed       = seed;
  return parameters;
}



double
smallest_gap(const Scene<3> &scene)
{
  double smallest = 1e10;
  for (unsigned int i = 0; i < scene.particles.size(); ++i)
    {
      const auto &p = scene.particles[i];
      smallest      = std::min(smallest,
                          scene.height / 2. - std::abs(p.centre[1]) - p.radius);
      if (!scene.mirrored())
        smallest =
          std::min(smallest,
                   scene.width / 2. - std::abs(p.centre[2]) - p.radius);
      for (unsigned int j = 0; j <= i; ++j)
        smallest = std::min(smallest, scene.gap(i, j));
    }
  return smallest;
}



bool
same_places(const Scene<3> &a, const Scene<3> &b)
{
  for (unsigned int i = 0; i < a.particles.size(); ++i)
    if (a.particles[i].centre != b.particles[i].centre)
      return false;
  return true;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const Symmetry symmetry : {Symmetry::none, Symmetry::half})
      {
        const std::string name =
          symmetry == Symmetry::none ? "in the box: " : "on the mirror plane: ";
        const auto     parameters = crowd(symmetry, 1);
        const Scene<3> scene      = parameters.scene<3>();
        parameters.check();
        claims.near(name + "as many as asked for",
                    scene.particles.size(),
                    parameters.number + 1,
                    0.);
        claims.at_least(name + "gap",
                        smallest_gap(scene),
                        parameters.smallest_distance);
        claims.holds(name + "the listed particle stays",
                     scene.particles[0].centre == Point<3>(1., 2., 0.));
        bool right_radii = true, in_plane = true;
        for (unsigned int i = 0; i < scene.particles.size(); ++i)
          {
            right_radii &= scene.particles[i].radius == parameters.radii[i % 3];
            in_plane &= scene.particles[i].centre[2] == 0.;
          }
        claims.holds(name + "radii in their order", right_radii);
        claims.holds(name + "z", in_plane == scene.mirrored());
        claims.holds(name + "the same seed gives the same places",
                     same_places(scene, crowd(symmetry, 1).scene<3>()));
        claims.holds(name + "another seed gives others",
                     !same_places(scene, crowd(symmetry, 2).scene<3>()));
      }

    ManyParticlesParameters parameters;
    parameters.volume_fraction = 0.1;
    double volume              = 0.;
    for (const auto &particle : parameters.scene<3>().particles)
      volume += 4. / 3. * numbers::PI * std::pow(particle.radius, 3);
    claims.near("volume fraction", volume / 8000., 0.1, 2.1 / 8000.);

    parameters.volume_fraction = 0.;
    parameters.number          = 2000;
    const std::string message  = Tests::refusal([&]() { parameters.check(); });
    claims.holds("too many are refused by name",
                 message.find("'Scene/Number' = 2000") != std::string::npos);

    parameters.number     = 2;
    parameters.box.height = 2.2;
    claims.holds("so is a box without room for the distance from the walls",
                 Tests::refusal([&]() {
                   parameters.check();
                 }).find("'Scene/Height' = 2.2") != std::string::npos);
  });
}

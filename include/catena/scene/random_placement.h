#ifndef catena_scene_random_placement_h
#define catena_scene_random_placement_h

#include <catena/scene/scene.h>

#include <vector>

namespace Catena
{
  /**
   * Add particles to @p scene, one for each entry of @p radii and in this
   * order, by random sequential addition: each at a place uniformly at random
   * among those where no gap, to particles already there, to their images, to
   * walls and to mirror planes, is smaller than @p smallest_gap. Larger
   * particles are placed first. In a mirrored scene all centres lie on z = 0.
   *
   * The same @p seed gives the same places on every machine.
   *
   * @throws InputError if the box is too small for the largest particle or for
   * the volume of all, or a particle has found no place in 100,000 trials
   */
  template <int dim>
  void
  place_at_random(Scene<dim>                &scene,
                  const std::vector<double> &radii,
                  const double               smallest_gap,
                  const unsigned int         seed);
} // namespace Catena

#endif

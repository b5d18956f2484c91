#ifndef catena_scene_image_in_block_h
#define catena_scene_image_in_block_h

#include <catena/scene/scene.h>

namespace Catena
{
  /**
   * The image under which @p point lies in the meshed block of @p scene: none
   * if it does or if no image does.
   */
  template <int dim>
  Image<dim>
  image_in_block(const Scene<dim> &scene, const dealii::Point<dim> &point);
} // namespace Catena

#endif

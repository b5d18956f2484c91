#include <catena/scene/image_in_block.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  Image<dim>
  image_in_block(const Scene<dim> &scene, const Point<dim> &point)
  {
    const Point<dim> low = scene.lower(), high = scene.upper();
    for (const Image<dim> &image : scene.images())
      {
        const Point<dim> p = image(point);
        if (p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] &&
            p[1] <= high[1])
          return image;
      }
    return {};
  }



  template Image<2>
  image_in_block(const Scene<2> &, const Point<2> &);
  template Image<3>
  image_in_block(const Scene<3> &, const Point<3> &);
} // namespace Catena

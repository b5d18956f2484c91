#include <catena/mesh/size_field.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// the smallest size is at least this share of that on the surface
    constexpr double smallest_share = 1. / 50.;

    /// elements between a particle and an identified plane close to it
    constexpr double elements_across_cut = 1. / 3.;

    /// elements grow no faster than this per unit of distance
    constexpr double largest_growth = 0.5;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Distance of @p p to the block, 0 inside.
    template <int dim>
    double
    distance_to_block(const Point<dim> &p,
                      const Point<dim> &lower,
                      const Point<dim> &upper)
    {
      dealii::Tensor<1, dim> outside;
      for (unsigned int d = 0; d < dim; ++d)
        outside[d] = std::max({lower[d] - p[d], p[d] - upper[d], 0.});
      return outside.norm();
    }
  } // namespace



  template <int dim>
  SizeField<dim>::SizeField(const Scene<dim>     &scene,
                            const MeshParameters &parameters,
                            const double          scale)
    : growth(
        std::min(largest_growth,
                 parameters.growth *
                   std::pow(64. / parameters.elements_on_equator, 2. / 3.)))
    , maximal_size(parameters.maximal_size)
    , elements_on_equator(parameters.elements_on_equator)
    , elements_across_gap(parameters.elements_across_gap)
    , scale(scale)
    , gap(infinity)
  {
    collect_spheres(scene);
    collect_planes(scene);
    find_narrowest_gap();
  }



  template <int dim>
  void
  SizeField<dim>::collect_spheres(const Scene<dim> &scene)
  {
    const Point<dim> lower = scene.lower();
    const Point<dim> upper = scene.upper();

    for (const auto &particle : scene.particles)
      for (const auto &image : scene.images())
        {
          const Point<dim> centre = image(particle.centre);
          // the size at the block is capped before such an image matters
          const double reach =
            particle.radius +
            maximal_size * std::max(1. / growth, elements_across_gap);
          const bool far = distance_to_block(centre, lower, upper) > reach;
          const bool known =
            std::any_of(spheres.begin(), spheres.end(), [&](const auto &s) {
              return s.centre.distance(centre) < 1e-8 * s.radius;
            });
          if (!far && !known)
            spheres.push_back({centre, particle.radius, {}});
        }
  }



  template <int dim>
  void
  SizeField<dim>::collect_planes(const Scene<dim> &scene)
  {
    planes = {{1, -scene.height / 2., elements_across_gap},
              {1, scene.height / 2., elements_across_gap}};
    if (dim == 3)
      {
        const double low = scene.mirrored() ? 0. : -scene.width / 2.;
        planes.push_back({dim - 1, low, elements_across_gap});
        planes.push_back({dim - 1, scene.width / 2., elements_across_gap});
      }
    planes.push_back({0, scene.lower()[0], elements_across_cut});
    planes.push_back({0, scene.upper()[0], elements_across_cut});
    if (scene.rotational() && scene.cut == Cut::y_plane)
      planes.push_back({1, 0., elements_across_cut});

    for (auto &sphere : spheres)
      for (unsigned int i = 0; i < planes.size(); ++i)
        {
          const double width =
            std::abs(sphere.centre[planes[i].direction] - planes[i].position) -
            sphere.radius;
          if (width > 0. && width < maximal_size * planes[i].elements_across)
            sphere.planes.push_back(i);
        }
  }



  template <int dim>
  void
  SizeField<dim>::find_narrowest_gap()
  {
    for (unsigned int i = 0; i < spheres.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        gap = std::min(gap,
                       spheres[i].centre.distance(spheres[j].centre) -
                         spheres[i].radius - spheres[j].radius);
  }



  template <int dim>
  double
  SizeField<dim>::operator()(const Point<dim> &p) const
  {
    double size    = maximal_size;
    double nearest = infinity;
    double second  = infinity;
    double surface = infinity;

    for (const auto &sphere : spheres)
      {
        const double distance =
          std::max(sphere.centre.distance(p) - sphere.radius, 0.);
        const double h0 =
          2. * dealii::numbers::PI * sphere.radius / elements_on_equator;

        size    = std::min(size, h0 + growth * distance);
        surface = std::min(surface, h0);
        second  = std::min(second, std::max(distance, nearest));
        nearest = std::min(nearest, distance);
        for (const unsigned int i : sphere.planes)
          {
            const double width =
              distance + std::abs(p[planes[i].direction] - planes[i].position);
            size = std::min(size, width / planes[i].elements_across);
          }
      }

    const double width = std::max(nearest + second, gap);
    size               = std::min(size, width / elements_across_gap);
    if (surface < infinity)
      size = std::max(size, smallest_share * surface);
    return scale * size;
  }



  template class SizeField<2>;
  template class SizeField<3>;
} // namespace Catena

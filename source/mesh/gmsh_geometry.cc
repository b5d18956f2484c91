#include <catena/mesh/gmsh_geometry.h>
#include <catena/scene/image_in_block.h>

#include <deal.II/base/numbers.h>

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// Parts of the line through (x, y) along z that no particle covers.
    std::vector<std::array<double, 2>>
    free_segments(const Scene<3> &scene, const double x, const double y)
    {
      std::vector<std::array<double, 2>> segments = {
        {{scene.lower()[2], scene.upper()[2]}}};
      for (const auto &surface : scene.surfaces())
        {
          const Point<3> &c = surface.centre;
          const double rho2 = (x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]);
          const double r2   = surface.radius * surface.radius;
          if (rho2 >= r2)
            continue;
          const double reach = std::sqrt(r2 - rho2);

          std::vector<std::array<double, 2>> parts;
          for (const auto &s : segments)
            {
              if (s[0] < c[2] - reach)
                parts.push_back({{s[0], std::min(s[1], c[2] - reach)}});
              if (s[1] > c[2] + reach)
                parts.push_back({{std::max(s[0], c[2] + reach), s[1]}});
            }
          segments = parts;
        }
      return segments;
    }



    /**
     * Direction in the x-y plane of the seam of a sphere: out of the block for
     * a particle on the axis, straight away from a plane that it crosses, else
     * away from the nearest neighbour. It is turned with an image, so that the
     * curves on identified planes are images of each other.
     */
    template <int dim>
    double
    seam_angle(const Scene<dim> &scene, const Surface<dim> &surface)
    {
      const Particle<dim> &particle = scene.particles[surface.particle];
      if (particle.on_axis)
        return scene.cut == Cut::x_plane ? dealii::numbers::PI :
                                           -dealii::numbers::PI_2;

      const Image<dim>       home   = image_in_block(scene, particle.centre);
      const Point<dim>       centre = home(particle.centre);
      dealii::Tensor<1, dim> away;
      for (unsigned int d = 0; d < 2; ++d)
        {
          if (centre[d] - particle.radius < scene.lower()[d])
            away[d] += 1.;
          if (centre[d] + particle.radius > scene.upper()[d])
            away[d] -= 1.;
        }
      double nearest = away.norm() > 0. ? 0. : scene.length;
      for (const auto &other : scene.particles)
        for (const auto &image : scene.images())
          {
            const double distance = image(other.centre).distance(centre);
            if (distance > geometric_tolerance && distance < nearest)
              {
                nearest = distance;
                away    = centre - image(other.centre);
              }
          }
      away = surface.image.turn(home.turn(away));
      return std::atan2(away[1], away[0]);
    }
  } // namespace



  template <int dim>
  std::vector<double>
  split_positions(const Scene<dim>          &scene,
                  const Identification<dim> &identification)
  {
    if (identification.from != BoundaryIds::y_low)
      return {0.};

    const double low    = scene.lower()[0];
    const double high   = scene.upper()[0];
    const double period = identification.period;

    std::vector<double> positions;
    for (const double x : {identification.shift,
                           identification.shift + period / 2.,
                           2. * identification.shift - low})
      {
        const double wrapped = x - period * std::floor((x - low) / period);
        const bool   known =
          std::any_of(positions.begin(), positions.end(), [&](double y) {
            return std::abs(y - wrapped) < geometric_tolerance;
          });
        if (!known && wrapped - low > geometric_tolerance &&
            high - wrapped > geometric_tolerance)
          positions.push_back(wrapped);
      }
    return positions;
  }



  template <int dim>
  gmsh::vectorpair
  splitting_entities(const Scene<dim> &scene, const double x, const double y)
  {
    gmsh::vectorpair entities;
    if constexpr (dim == 3)
      for (const auto &segment : free_segments(scene, x, y))
        {
          const int a = gmsh::model::occ::addPoint(x, y, segment[0]);
          const int b = gmsh::model::occ::addPoint(x, y, segment[1]);
          entities.emplace_back(1, gmsh::model::occ::addLine(a, b));
        }
    else
      {
        const auto surfaces = scene.surfaces();
        const bool covered =
          std::any_of(surfaces.begin(), surfaces.end(), [&](const auto &s) {
            return s.centre.distance(Point<dim>(x, y)) <= s.radius;
          });
        if (!covered)
          entities.emplace_back(0, gmsh::model::occ::addPoint(x, y, 0.));
      }
    return entities;
  }



  template <int dim>
  int
  add_particle(const Scene<dim> &scene, const Surface<dim> &surface)
  {
    const double      radius = surface.radius;
    const Point<dim> &c      = surface.centre;
    const double      z      = dim == 3 ? c[dim - 1] : 0.;
    const int         tag    = dim == 3 ?
                                 gmsh::model::occ::addSphere(c[0], c[1], z, radius) :
                                 gmsh::model::occ::addDisk(c[0], c[1], z, radius, radius);
    gmsh::model::occ::rotate(
      {{dim, tag}}, c[0], c[1], z, 0., 0., 1., seam_angle(scene, surface));
    return tag;
  }



  template std::vector<double>
  split_positions(const Scene<2> &, const Identification<2> &);
  template gmsh::vectorpair
  splitting_entities(const Scene<2> &, const double, const double);
  template int
  add_particle(const Scene<2> &, const Surface<2> &);
  template std::vector<double>
  split_positions(const Scene<3> &, const Identification<3> &);
  template gmsh::vectorpair
  splitting_entities(const Scene<3> &, const double, const double);
  template int
  add_particle(const Scene<3> &, const Surface<3> &);
} // namespace Catena

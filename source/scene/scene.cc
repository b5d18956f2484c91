#include <catena/base/exceptions.h>
#include <catena/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  Point<dim>
  Identification<dim>::image(const Point<dim> &p) const
  {
    Point<dim> q = p;
    if (rotation)
      {
        q[0] = 2. * shift - p[0];
        q[1] = -p[1];
      }
    else
      q[0] += shift;
    return q;
  }



  template <int dim>
  Point<dim>
  Scene<dim>::lower() const
  {
    Point<dim> p;
    p[0] = window_centre - length / 2.;
    p[1] = -height / 2.;
    if (rotational() && cut == Cut::x_plane)
      p[0] = 0.;
    if (rotational() && cut == Cut::y_plane)
      p[1] = 0.;
    if (dim == 3)
      p[dim - 1] = mirrored() ? 0. : -width / 2.;
    return p;
  }



  template <int dim>
  Point<dim>
  Scene<dim>::upper() const
  {
    Point<dim> p;
    p[0] = window_centre + length / 2.;
    p[1] = height / 2.;
    if (rotational() && cut == Cut::x_plane)
      p[0] = length / 2.;
    if (dim == 3)
      p[dim - 1] = width / 2.;
    return p;
  }



  template <int dim>
  double
  Scene<dim>::section() const
  {
    double area = 1.;
    for (unsigned int d = 1; d < dim; ++d)
      area *= upper()[d] - lower()[d];
    return area;
  }



  template <int dim>
  std::vector<Identification<dim>>
  Scene<dim>::identifications() const
  {
    using namespace BoundaryIds;
    if (!rotational())
      return {{x_low, x_high, false, length}};
    if (cut == Cut::x_plane)
      return {{x_low, x_low, true, 0.}, {x_high, x_high, true, length / 2.}};
    return {{y_low, y_low, true, 0., length}, {x_low, x_high, false, length}};
  }



  template <int dim>
  std::vector<Image<dim>>
  Scene<dim>::images() const
  {
    std::vector<Image<dim>> result;
    for (const double shift : {0., -length, length})
      {
        result.push_back({false, shift});
        if (rotational())
          result.push_back({true, shift});
      }
    return result;
  }



  template <int dim>
  Image<dim>
  Scene<dim>::nearest_image(const std::vector<Point<dim>> &centres,
                            const unsigned int             i,
                            const unsigned int             j) const
  {
    const std::vector<Image<dim>> all      = images();
    double                        distance = std::numeric_limits<double>::max();
    Image<dim>                    nearest;
    for (unsigned int k = (i == j ? 1 : 0); k < all.size(); ++k)
      {
        const double d = centres[i].distance(all[k](centres[j]));
        if (d < distance)
          {
            distance = d;
            nearest  = all[k];
          }
      }
    return nearest;
  }



  template <int dim>
  std::vector<Surface<dim>>
  Scene<dim>::surfaces() const
  {
    const Point<dim>          low = lower(), high = upper();
    std::vector<Surface<dim>> result;
    for (const Image<dim> &image : images())
      for (unsigned int i = 0; i < particles.size(); ++i)
        {
          const Point<dim> centre = image(particles[i].centre);
          const double     radius = particles[i].radius;
          bool             meets  = true;
          for (unsigned int d = 0; d < dim; ++d)
            meets &=
              centre[d] + radius > low[d] && centre[d] - radius < high[d];
          // a particle on the axis is its own image
          const bool known =
            std::any_of(result.begin(), result.end(), [&](const auto &other) {
              return other.particle == i &&
                     other.centre.distance(centre) < 1e-8 * radius;
            });
          if (meets && !known)
            result.push_back({i, image, centre, radius});
        }
    return result;
  }



  template <int dim>
  double
  Scene<dim>::multiplicity(const unsigned int particle) const
  {
    return (in_mirror_plane(particle) ? 2. : 1.) *
           (particles[particle].on_axis ? 2. : 1.);
  }



  template <int dim>
  double
  Scene<dim>::gap(const unsigned int i, const unsigned int j) const
  {
    const std::vector<Point<dim>> centres = {particles[i].centre,
                                             particles[j].centre};
    const unsigned int            other   = i == j ? 0 : 1;
    const double                  distance =
      centres[0].distance(nearest_image(centres, 0, other)(centres[other]));
    return distance - particles[i].radius - particles[j].radius;
  }



  template <int dim>
  double
  Scene<dim>::line_angle(const std::vector<Point<dim>> &centres) const
  {
    if (!line)
      return 0.;
    const unsigned int to = (*line)[0], from = (*line)[1];
    Tensor<1, dim>     direction = centres[to];
    if (to != from)
      direction -= nearest_image(centres, to, from)(centres[from]);
    return std::atan2(direction[1], direction[0]);
  }



  template <int dim>
  Tensor<1, dim>
  Scene<dim>::imposed_velocity(const Point<dim> &p)
  {
    Tensor<1, dim> u;
    u[0] = -p[1];
    return u;
  }



  template <int dim>
  Tensor<2, dim>
  Scene<dim>::imposed_gradient()
  {
    Tensor<2, dim> gradient;
    gradient[0][1] = -1.;
    return gradient;
  }



  template <int dim>
  void
  Scene<dim>::check() const
  {
    require(length > 0., "Scene/Length", length, "give a positive length");
    require(height > 0., "Scene/Height", height, "give a positive height");
    require(width > 0., "Scene/Width", width, "give a positive width");

    require(!(pressure_driven() && rotational()),
            "Scene/Domain",
            "quarter",
            "a flow along the channel has no rotational symmetry, choose half "
            "or full");

    const Point<dim> low = lower(), high = upper();
    for (unsigned int i = 0; i < particles.size(); ++i)
      {
        const Particle<dim> &p    = particles[i];
        const std::string    name = "centre of particle " + std::to_string(i);
        require(p.radius > 0.,
                "radius of particle " + std::to_string(i),
                p.radius,
                "give a positive radius");
        require(std::abs(p.centre[1]) + p.radius < height / 2.,
                name,
                p.centre,
                "the particle is in a wall; move it or enlarge the box");
        if (p.on_axis)
          require(p.centre == Point<dim>(),
                  name,
                  p.centre,
                  "a particle on the axis must have its centre at the origin");
        if (dim == 3)
          {
            require(p.radius < high[dim - 1],
                    "Scene/Width",
                    width,
                    "enlarge the box: it must be wider than a particle");
            const double z = p.centre[dim - 1];
            require(in_mirror_plane(i) || (z - p.radius > low[dim - 1] &&
                                           z + p.radius < high[dim - 1]),
                    name,
                    p.centre,
                    "the particle crosses a mirror plane; put its centre on "
                    "z = 0 or choose another symmetry");
          }

        for (unsigned int j = 0; j <= i; ++j)
          if (!(i == j && p.on_axis))
            require(gap(i, j) > 0.,
                    "gap between particles " + std::to_string(j) + " and " +
                      std::to_string(i),
                    gap(i, j),
                    "the particles overlap; move them apart");
      }
  }



  template struct Identification<2>;
  template struct Identification<3>;
  template class Scene<2>;
  template class Scene<3>;
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/scene/scene.h>

#include <algorithm>
#include <cmath>

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
    p[0] = -length / 2.;
    p[1] = -height / 2.;
    if (rotational() && cut == Cut::x_plane)
      p[0] = 0.;
    if (rotational() && cut == Cut::y_plane)
      {
        p[0] += window_centre;
        p[1] = 0.;
      }
    if (dim == 3)
      p[dim - 1] = mirrored() ? 0. : -width / 2.;
    return p;
  }



  template <int dim>
  Point<dim>
  Scene<dim>::upper() const
  {
    Point<dim> p;
    p[0] = length / 2.;
    p[1] = height / 2.;
    if (rotational() && cut == Cut::y_plane)
      p[0] += window_centre;
    if (dim == 3)
      p[dim - 1] = width / 2.;
    return p;
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
  std::vector<Point<dim>>
  Scene<dim>::rotated_images(const Point<dim> &p) const
  {
    std::vector<Point<dim>> images{p};
    if (rotational())
      {
        Point<dim> rotated = p;
        rotated[0]         = -p[0];
        rotated[1]         = -p[1];
        images.push_back(rotated);
      }
    const unsigned int n = images.size();
    for (const double move : {-length, length})
      for (unsigned int i = 0; i < n; ++i)
        {
          images.push_back(images[i]);
          images.back()[0] += move;
        }
    return images;
  }



  template <int dim>
  double
  Scene<dim>::multiplicity(const unsigned int particle) const
  {
    const Particle<dim> &p         = particles[particle];
    const bool           on_mirror = mirrored() && p.centre[dim - 1] == 0.;
    return (on_mirror ? 2. : 1.) * (p.on_axis ? 2. : 1.);
  }



  template <int dim>
  double
  Scene<dim>::gap(const unsigned int i, const unsigned int j) const
  {
    const std::vector<Point<dim>> images = rotated_images(particles[j].centre);
    double                        distance = std::numeric_limits<double>::max();
    for (unsigned int k = (i == j ? 1 : 0); k < images.size(); ++k)
      distance = std::min(distance, particles[i].centre.distance(images[k]));
    return distance - particles[i].radius - particles[j].radius;
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
          require(p.centre[0] == 0. && p.centre[1] == 0.,
                  name,
                  p.centre,
                  "a particle on the axis must have its centre at x = y = 0");
        else
          for (unsigned int d = 0; d < 2; ++d)
            require(p.centre[d] - p.radius > low[d] &&
                      p.centre[d] + p.radius < high[d],
                    name,
                    p.centre,
                    "the particle crosses a plane that bounds the meshed "
                    "block; move it or choose another symmetry");
        if (dim == 3)
          {
            require(p.radius < high[dim - 1],
                    "Scene/Width",
                    width,
                    "enlarge the box: it must be wider than a particle");
            const double z         = p.centre[dim - 1];
            const bool   on_mirror = mirrored() && z == 0.;
            require(on_mirror || (z - p.radius > low[dim - 1] &&
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

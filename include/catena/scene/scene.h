#ifndef catena_scene_scene_h
#define catena_scene_scene_h

#include <catena/scene/image.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <array>
#include <optional>
#include <vector>

namespace Catena
{
  /**
   * How much of the box is meshed.
   *
   * - `none`: all of it.
   * - `half`: z >= 0, by mirror symmetry (dim = 3 only).
   * - `quarter`: also rotationally symmetric by 180 degrees about the z-axis;
   *   in two dimensions the rotation alone, which leaves half of the box.
   */
  enum class Symmetry
  {
    none,
    half,
    quarter
  };

  /**
   * The plane along which the box is cut in two when it is rotationally
   * symmetric: x = 0 or y = 0. Both give the same flow.
   */
  enum class Cut
  {
    x_plane,
    y_plane
  };

  /**
   * What drives the flow.
   *
   * - `walls`: they move in opposite directions, u = -y e_x without particles;
   *   times are in units of 1/gamma.
   * - `pressure`: the walls are at rest, and the pressure falls by as much
   *   along a period as it takes for a mean velocity of 1 along x; times are in
   *   units of a/U, U the mean velocity of the channel.
   */
  enum class Drive
  {
    walls,
    pressure
  };

  /**
   * Boundary ids of a mesh. Surface i of Scene::surfaces() has the id
   * `particle + i`; as long as no particle crosses a plane that bounds the
   * meshed block, surface i is that of particle i.
   */
  namespace BoundaryIds
  {
    constexpr dealii::types::boundary_id x_low    = 0;
    constexpr dealii::types::boundary_id x_high   = 1;
    constexpr dealii::types::boundary_id y_low    = 2;
    constexpr dealii::types::boundary_id y_high   = 3;
    constexpr dealii::types::boundary_id z_low    = 4;
    constexpr dealii::types::boundary_id z_high   = 5;
    constexpr dealii::types::boundary_id particle = 10;
  } // namespace BoundaryIds

  /**
   * A rigid sphere (disc for dim = 2) that is meshed. Images under the
   * symmetries of the scene are not listed.
   */
  template <int dim>
  struct Particle
  {
    dealii::Point<dim> centre;
    double             radius = 1.;

    /**
     * The centre lies on the axis of the rotational symmetry: half of the
     * particle is meshed and it can only turn.
     */
    bool on_axis = false;

    /// Held in place by whatever force and torque it takes.
    bool fixed = false;
  };

  /**
   * The part of a particle's surface, or of that of an image of it, that lies
   * in the meshed block.
   */
  template <int dim>
  struct Surface
  {
    unsigned int       particle;
    Image<dim>         image;
    dealii::Point<dim> centre;
    double             radius;

    /// The point of the surface on the ray from the centre through @p p.
    dealii::Point<dim>
    nearest(const dealii::Point<dim> &p) const
    {
      const dealii::Tensor<1, dim> r = p - centre;
      return centre + radius / r.norm() * r;
    }
  };

  /**
   * Two parts of the boundary that are the same material surface: the nodes
   * of @p from are carried to nodes of @p to by a rotation of 180 degrees
   * about the line (x, y) = (axis, 0), or by a translation along x.
   */
  template <int dim>
  struct Identification
  {
    dealii::types::boundary_id from;
    dealii::types::boundary_id to;
    bool                       rotation;
    /// x of the axis for a rotation, else the distance of the translation
    double shift;
    /// the image may have to be moved by multiples of this along x, 0: never
    double period = 0.;

    /// Image of @p p, before any move by the period.
    dealii::Point<dim>
    image(const dealii::Point<dim> &p) const;
  };

  /**
   * What is simulated: the box, the part of it that is meshed, and the
   * particles at the start. Lengths in particle radii a.
   *
   * The box is L x H x W with its centroid at the origin, walls at
   * y = -H/2, H/2, periodic in x, mirror planes at z = -W/2, W/2 (and z = 0
   * when halved).
   */
  template <int dim>
  class Scene
  {
  public:
    double   length   = 80.;
    double   height   = 40.;
    double   width    = 20.;
    Symmetry symmetry = Symmetry::none;
    Cut      cut      = Cut::x_plane;
    Drive    drive    = Drive::walls;

    /// x of the middle of the meshed period, unless the cut is the plane x = 0
    double window_centre = 0.;

    std::vector<Particle<dim>> particles;

    /**
     * The particles whose line of centres has the angle theta, which the mesh
     * on the surfaces of the particles follows: from the second to the first,
     * or from the axis if both are the same. Without it there is no theta.
     */
    std::optional<std::array<unsigned int, 2>> line;

    bool
    rotational() const
    {
      return symmetry == Symmetry::quarter;
    }

    bool
    mirrored() const
    {
      return dim == 3 && symmetry != Symmetry::none;
    }

    /// Is only half of a particle meshed, the other one mirrored?
    bool
    in_mirror_plane(const unsigned int particle) const
    {
      return mirrored() && particles[particle].centre[dim - 1] == 0.;
    }

    bool
    pressure_driven() const
    {
      return drive == Drive::pressure;
    }

    /// Area of the meshed part of the channel's section x = 0, without
    /// particles; for dim = 2 its height.
    double
    section() const;

    /// Corner of the meshed block with the smallest coordinates.
    dealii::Point<dim>
    lower() const;

    /// Corner of the meshed block with the largest coordinates.
    dealii::Point<dim>
    upper() const;

    std::vector<Identification<dim>>
    identifications() const;

    /**
     * The rotation and the period of the scene: the identity first, then the
     * rotation, then both moved by one period to either side.
     */
    std::vector<Image<dim>>
    images() const;

    /**
     * The image of @p j, other than itself for i == j, whose centre is nearest
     * to that of @p i when the centres are at @p centres.
     */
    Image<dim>
    nearest_image(const std::vector<dealii::Point<dim>> &centres,
                  const unsigned int                     i,
                  const unsigned int                     j) const;

    /**
     * What of the particles and their images meets the meshed block: the
     * particles that do first, in their order.
     */
    std::vector<Surface<dim>>
    surfaces() const;

    /**
     * The share of a particle that is meshed is 1/multiplicity; a force on
     * the meshed part times the multiplicity is the force on the particle.
     */
    double
    multiplicity(const unsigned int particle) const;

    /**
     * Smallest distance between the surfaces of particle @p i and particle
     * @p j or any image of it, for i == j between i and its own images.
     */
    double
    gap(const unsigned int i, const unsigned int j) const;

    /**
     * theta, the angle of the line of centres about z, in [-pi, pi], when the
     * centres are at @p centres; 0 without a line.
     */
    double
    line_angle(const std::vector<dealii::Point<dim>> &centres) const;

    /**
     * Imposed shear flow u = (-y, 0, 0) of rate 1, in units of gamma a.
     */
    static dealii::Tensor<1, dim>
    imposed_velocity(const dealii::Point<dim> &p);

    /// Gradient L of the imposed flow of rate 1, L_ij = du_i/dx_j.
    static dealii::Tensor<2, dim>
    imposed_gradient();

    /**
     * @throws InputError if the box or the particles make no sense: particles
     * that overlap each other, a wall or a plane they should not cross, or a
     * pressure-driven flow with a rotational symmetry it does not have.
     */
    void
    check() const;
  };
} // namespace Catena

#endif

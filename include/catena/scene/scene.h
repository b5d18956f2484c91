#ifndef catena_scene_scene_h
#define catena_scene_scene_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <array>
#include <string>
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
   * symmetric: x = 0 or y = 0. Both give the same flow; the one that stays
   * clear of the particles is used.
   */
  enum class Cut
  {
    x_plane,
    y_plane
  };

  /**
   * Boundary ids of a mesh. Particle i has the id `particle + i`.
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

    /**
     * Sign of component @p d of a vector under the identification.
     */
    double
    vector_sign(const unsigned int d) const
    {
      return rotation && d < 2 ? -1. : 1.;
    }
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

    /// x of the middle of the meshed period when the cut is the plane y = 0
    double window_centre = 0.;

    std::vector<Particle<dim>> particles;

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

    /// Corner of the meshed block with the smallest coordinates.
    dealii::Point<dim>
    lower() const;

    /// Corner of the meshed block with the largest coordinates.
    dealii::Point<dim>
    upper() const;

    std::vector<Identification<dim>>
    identifications() const;

    /**
     * Images of @p p under the rotation and the period of the scene: the
     * identity first, then the rotation, then both moved by one period to
     * either side.
     */
    std::vector<dealii::Point<dim>>
    rotated_images(const dealii::Point<dim> &p) const;

    /**
     * The share of a particle that is meshed is 1/multiplicity; a force on
     * the meshed part times the multiplicity is the force on the particle.
     */
    double
    multiplicity(const unsigned int particle) const;

    /**
     * Smallest distance between the surfaces of particle @p i and particle
     * @p j, or for i == j between i and its image under the rotation.
     */
    double
    gap(const unsigned int i, const unsigned int j) const;

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
     * that overlap each other, a wall or a plane they should not cross.
     */
    void
    check() const;
  };
} // namespace Catena

#endif

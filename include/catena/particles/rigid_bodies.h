#ifndef catena_particles_rigid_bodies_h
#define catena_particles_rigid_bodies_h

#include <catena/base/archive.h>
#include <catena/scene/scene.h>

#include <deal.II/base/tensor.h>

#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Translation and rotation of a particle: u = U + omega x (x - X) on its
   * surface. In two dimensions only the z-component of omega is used.
   */
  template <int dim>
  struct RigidMotion
  {
    dealii::Tensor<1, dim> velocity;         ///< [a gamma]
    dealii::Tensor<1, 3>   angular_velocity; ///< [gamma]

    /// Velocity of the surface point at @p arm from the centre.
    dealii::Tensor<1, dim>
    at(const dealii::Tensor<1, dim> &arm) const;

    /// Save or load it.
    void
    archive(Archive &archive)
    {
      archive(velocity, angular_velocity);
    }
  };



  /**
   * The unknown motions of the particles, numbered one after the other: of
   * each particle only those its place in the scene allows. A particle on a
   * mirror plane moves in the plane and turns about z, one on the axis of
   * rotational symmetry only turns, any other has all its dim translations
   * and its one (dim = 2) or three rotations.
   *
   * While the particles are held in place their translations are known to be
   * zero and only the rotations are solved for; of a fixed particle not even
   * these.
   */
  template <int dim>
  class RigidBodies
  {
  public:
    /// One unknown: translation along, or rotation about, an axis.
    struct Unknown
    {
      unsigned int particle;
      bool         rotation;
      unsigned int axis;
    };

    explicit RigidBodies(const Scene<dim> &scene);

    unsigned int
    n_unknowns() const
    {
      return unknowns.size();
    }

    const Unknown &
    unknown(const unsigned int k) const
    {
      return unknowns[k];
    }

    /// Share of its particle's force that the meshed part carries.
    double
    meshed_share(const unsigned int k) const
    {
      return shares[unknowns[k].particle];
    }

    /**
     * Volume (area for dim = 2) of its particle if unknown @p k is the
     * translation along x, else 0: what a uniform gradient of the pressure
     * along x does work on.
     */
    double
    displaced_volume(const unsigned int k) const;

    void
    hold_in_place(const bool held)
    {
      held_in_place = held;
    }

    /// Is unknown @p k solved for?
    bool
    is_free(const unsigned int k) const
    {
      return !fixed[unknowns[k].particle] &&
             !(held_in_place && !unknowns[k].rotation);
    }

    /// Is any unknown not solved for?
    bool
    any_held() const;

    bool
    is_fixed(const unsigned int particle) const
    {
      return fixed[particle];
    }

    /// Velocity at @p arm from the centre for a unit value of unknown @p k.
    dealii::Tensor<1, dim>
    unit_velocity(const unsigned int            k,
                  const dealii::Tensor<1, dim> &arm) const;

    /// First and one past the last unknown of a particle.
    std::pair<unsigned int, unsigned int>
    range(const unsigned int particle) const
    {
      return {offsets[particle], offsets[particle + 1]};
    }

    /// Motions of all particles from the values of the unknowns.
    std::vector<RigidMotion<dim>>
    motions(const std::vector<double> &values) const;

    /// Values of the unknowns from motions.
    std::vector<double>
    values(const std::vector<RigidMotion<dim>> &motions) const;

  private:
    std::vector<Unknown>      unknowns;
    std::vector<unsigned int> offsets;
    std::vector<double>       shares, volumes;
    std::vector<bool>         fixed;
    bool                      held_in_place = false;
  };
} // namespace Catena

#endif

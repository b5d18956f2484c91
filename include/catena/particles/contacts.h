#ifndef catena_particles_contacts_h
#define catena_particles_contacts_h

#include <catena/particles/contact_forces.h>
#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>
#include <catena/scene/scene.h>

#include <vector>

namespace Catena
{
  /**
   * Two surfaces at the smallest gap: of particle i and its partner, which is
   * particle j or an image of it, or a wall, or a mirror plane behind which is
   * the mirror image of i.
   */
  template <int dim>
  struct Contact
  {
    enum class Partner
    {
      particle,
      wall,
      mirror_image
    };

    /// j is i if the partner is no other particle
    unsigned int i, j;

    /// unit vector from the partner (its centre) to the centre of i
    dealii::Tensor<1, dim> direction;

    /// the partner is this image of j
    Image<dim> image = {};

    Partner partner = Partner::particle;

    /**
     * One over the number of symmetries of the scene that leave the contact
     * as it is. The force F_r on the meshed parts of the particles is
     * meshed_share F_r rate(), by rigid-body unknown: like the meshed part of
     * the fluid, it does this share of the work.
     */
    double meshed_share = 1.;

    /**
     * Coefficients of the gap rate in the rigid-body unknowns,
     * rate = (X_i - X_j).(U_i - U_j)/|X_i - X_j|.
     */
    std::vector<double>
    rate(const RigidBodies<dim> &bodies) const;

    /// Save or load it.
    void
    archive(Archive &archive)
    {
      archive(i, j, direction, image, partner, meshed_share);
    }
  };



  /**
   * The forces of contacts on the whole particles, by rigid-body unknown.
   * @param forces F_r by contact [eta0 gamma a^2]
   */
  template <int dim>
  std::vector<double>
  forces_on_particles(const std::vector<Contact<dim>> &contacts,
                      const std::vector<double>       &forces,
                      const RigidBodies<dim>          &bodies);



  /**
   * The smallest gap 2 a d_min between surfaces (Jaensson et al. 2016, section
   * 2.3): of pairs of particles, of particles and images of particles under
   * the rotation, the period and the mirror planes of the scene, and of
   * particles and walls.
   *
   * A contact is a gap of exactly this width. Those whose force was repulsive
   * in the last solution of the flow are held: they are brought back to this
   * width after a step in time. All others may open.
   */
  template <int dim>
  class Contacts
  {
  public:
    /**
     * @param minimal_gap d_min, the gap divided by the diameter 2a
     */
    Contacts(const Scene<dim> &scene, const double minimal_gap);

    /// All contacts, whether there will be a force or not.
    std::vector<Contact<dim>>
    candidates(const Configuration<dim> &configuration) const;

    /**
     * Move the particles back to where no gap is below the smallest one and
     * the held ones are exactly the smallest one, to 1e-13, or at least to the
     * 1e-10 below which a gap counts as closed. The sum of the squares of the
     * displacements of all particles and images is the smallest in each of the
     * Newton steps. Held gaps that others do not allow to be exact may be
     * wider.
     *
     * @throws SolverError if the particles have no room
     */
    void
    enforce(Configuration<dim> &configuration) const;

    /**
     * Hold the contacts that repel, let go all others.
     * @param forces F_r by contact [eta0 gamma a^2]
     */
    void
    remember(const std::vector<Contact<dim>> &contacts,
             const std::vector<double>       &forces);

    /**
     * The last forces of @p contacts, zero for new ones. A contact is the same
     * if it has the same partners in about the same direction: also if they
     * have been replaced by their images since.
     */
    std::vector<double>
    remembered_forces(const std::vector<Contact<dim>> &contacts) const;

    /// Save or load the contacts that are held.
    void
    archive(Archive &archive)
    {
      archive(held);
    }

    unsigned int
    n_held() const
    {
      return held.size();
    }

    /// Smallest gap over the pairs of particles of which one can move, in
    /// diameters 2a; infinite without any.
    double
    smallest_gap(const Configuration<dim> &configuration) const;

  private:
    /// Two surfaces that may come into contact.
    struct Pair
    {
      unsigned int                   i, j;
      Image<dim>                     image; ///< of j
      typename Contact<dim>::Partner partner;
      /// x.normal + offset is the distance from a wall or mirror plane
      double                 offset = 0.;
      dealii::Tensor<1, dim> normal = {};
    };

    /// The contact of a pair, and its gap without the smallest one [a].
    struct Gap
    {
      Contact<dim> contact;
      double       excess;
    };

    struct HeldContact
    {
      Contact<dim> contact;
      double       force;

      void
      archive(Archive &archive)
      {
        archive(contact, force);
      }
    };

    const Scene<dim>         scene;
    const double             minimal_gap;
    const RigidBodies<dim>   bodies;
    const ContactForces      displacements;
    std::vector<Pair>        pairs;
    std::vector<HeldContact> held;

    void
    add_planes(const unsigned int particle);

    double
    meshed_share(const Contact<dim> &contact) const;

    Gap
    gap(const Configuration<dim> &configuration, const Pair &pair) const;

    double
    last_force(const Contact<dim> &contact) const;

    void
    displace(const std::vector<Gap> &gaps,
             std::vector<bool>      &exact,
             Configuration<dim>     &configuration) const;
  };
} // namespace Catena

#endif

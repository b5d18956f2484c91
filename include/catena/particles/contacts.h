#ifndef catena_particles_contacts_h
#define catena_particles_contacts_h

#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>
#include <catena/scene/scene.h>

#include <vector>

namespace Catena
{
  /**
   * Two surfaces at the smallest gap: of particles i and j, or of i and its
   * own image under the rotational symmetry (i == j).
   */
  template <int dim>
  struct Contact
  {
    unsigned int i, j;

    /// unit vector from the (image of the) centre of j to that of i
    dealii::Tensor<1, dim> direction;

    /// the image of j that i touches
    Image<dim> image;

    /**
     * Coefficients of the gap rate in the rigid-body unknowns,
     * rate = (X_i - X_j).(U_i - U_j)/|X_i - X_j|.
     */
    std::vector<double>
    rate(const RigidBodies<dim> &bodies) const;

    /**
     * Force on the meshed part of each particle by a unit repulsion F_r, in
     * the rows of the rigid-body unknowns.
     */
    std::vector<double>
    force(const RigidBodies<dim> &bodies) const;
  };



  /**
   * The smallest gap 2 a d_min between particle surfaces: which pairs are
   * held there, and the motion along the constraint (Jaensson et al. 2016,
   * section 2.3).
   *
   * A pair is held from the step in which its gap would fall below the
   * minimum, its surfaces are then kept at exactly that distance, and it is
   * let go in the step after its force has turned to attraction.
   */
  template <int dim>
  class Contacts
  {
  public:
    /**
     * @param minimal_gap d_min, the gap divided by the diameter 2a
     */
    Contacts(const Scene<dim> &scene, const double minimal_gap);

    /// Pairs held now.
    std::vector<Contact<dim>>
    held(const Configuration<dim> &configuration) const;

    unsigned int
    n_held() const;

    /**
     * Hold the pairs whose gap is below the minimum, unless they have only
     * just been let go, and move all these to exactly the smallest distance,
     * symmetrically, along their lines of centres.
     */
    void
    enforce(Configuration<dim> &configuration);

    /**
     * Let go the held pairs whose force is attractive.
     * @param forces F_r of the contacts in the order of held()
     */
    void
    release(const std::vector<double> &forces);

    /// Smallest gap over all pairs, in diameters 2a.
    double
    smallest_gap(const Configuration<dim> &configuration) const;

  private:
    struct Pair
    {
      unsigned int i, j;
      bool         is_held       = false;
      bool         just_released = false;
    };

    const Scene<dim>  scene;
    const double      minimal_gap;
    std::vector<Pair> pairs;

    /// Vector from the nearest image of j to i, and this image.
    std::pair<dealii::Tensor<1, dim>, Image<dim>>
    separation(const Configuration<dim> &configuration, const Pair &pair) const;

    /// Distance of centres at the smallest gap.
    double
    held_distance(const Pair &pair) const;
  };
} // namespace Catena

#endif

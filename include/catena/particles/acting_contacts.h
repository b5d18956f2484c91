#ifndef catena_particles_acting_contacts_h
#define catena_particles_acting_contacts_h

#include <catena/particles/contact_forces.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * Contacts as rows and columns of the rigid-body unknowns r: the gap rates
   * rates r >= given, and the forces shares F_r rates^T on the meshed parts of
   * the bodies.
   */
  struct ContactBlocks
  {
    dealii::FullMatrix<double> rates;  ///< contact by unknown
    std::vector<double>        shares; ///< Contact::meshed_share
    std::vector<double>        given;  ///< smallest gap rates

    unsigned int
    n_contacts() const
    {
      return given.size();
    }

    /// Those of the contacts that are in @p set.
    ContactBlocks
    subset(const std::vector<bool> &set) const;
  };



  /**
   * Which contacts act, in a system whose resistance to the motion of the
   * bodies is known only roughly but which can be solved with any set of
   * contacts as equations. The set is the solution of the complementarity
   * problem of ContactForces with the rough resistance about the last solution
   * (r, F): its free motion is r - R^-1 G^T F. From each two solutions the
   * resistance learns, by the formula of Broyden, Fletcher, Goldfarb and
   * Shanno, how the motion answers to the forces, so that none of their two
   * sets comes next.
   *
   * @code
   * ActingContacts acting(resistance, contacts, motion, forces);
   * do
   *   // solve with acting.set() for motion and forces
   * while (!acting.are_found(motion, forces, tolerance));
   * @endcode
   */
  class ActingContacts
  {
  public:
    /**
     * @param resistance rough resistance of the meshed parts; only its
     * diagonal is used if it is not positive definite
     * @param motion first guess of r
     * @param forces first guess of F_r, by contact
     * @throws SolverError if no set of contacts is found
     */
    ActingContacts(const dealii::FullMatrix<double> &resistance,
                   const ContactBlocks              &contacts,
                   const std::vector<double>        &motion,
                   const std::vector<double>        &forces);

    /// The contacts to take as equations; they are linearly independent.
    const std::vector<bool> &
    set() const
    {
      return acting;
    }

    /**
     * Are all contact forces repulsive and does no gap close, in the solution
     * with set()? If not, change the set.
     *
     * @param force_tolerance attraction that counts as no force; a gap rate
     * counts as none if a force like this would change it by as much
     * @throws SolverError if no other set of contacts is found
     */
    bool
    are_found(const std::vector<double> &motion,
              const std::vector<double> &forces,
              const double               force_tolerance);

  private:
    const ContactBlocks        contacts;
    dealii::FullMatrix<double> resistance;
    std::vector<bool>          acting;
    std::vector<double>        last_motion, last_pressure;
    bool                       has_solution = false;

    /// Force of the contacts on the meshed parts, by unknown.
    std::vector<double>
    pressure(const std::vector<double> &forces) const;

    void
    choose(const std::vector<double> &motion,
           const std::vector<double> &forces);

    void
    learn(const std::vector<double> &motion,
          const std::vector<double> &pressure);
  };
} // namespace Catena

#endif

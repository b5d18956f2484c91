#ifndef catena_particles_contact_forces_h
#define catena_particles_contact_forces_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace Catena
{
  /**
   * Rigid bodies that resist their motion r by R (r - r_0) and touch each
   * other. With G the rates of the gaps by unknown motion, the contact forces F
   * and the motion obey
   *
   *   R (r - r_0) = G^T F,   G r >= g,   F >= 0,   F.(G r - g) = 0;
   *
   * r is the motion with G r >= g that is closest to the free motion r_0 in the
   * norm of R, and unique. Where contacts depend on each other, as the 36 in a
   * cluster of 13 spheres, F is not: it is given with independent contacts.
   * A bilateral contact holds with G r = g and either sign of F.
   *
   * The active set method on the dual problem of D. Goldfarb and A. Idnani,
   * Math. Program. 27 (1983) 1-33: the most violated contact enters, those
   * whose force would fall below zero leave. The active contacts are always
   * linearly independent, and no set occurs twice.
   */
  class ContactForces
  {
  public:
    /**
     * @param resistance R, of which the symmetric part is used
     * @throws SolverError if it is not positive definite
     */
    explicit ContactForces(const dealii::FullMatrix<double> &resistance);

    struct Solution
    {
      std::vector<double> motion; ///< r
      std::vector<double> forces; ///< F, zero where not active
      std::vector<bool>   active; ///< contacts that are equations
    };

    /**
     * @param rates G, contact by unknown
     * @param given g
     * @param free_motion r_0
     * @param bilateral which contacts are; those that depend on others or
     * would force them to close are taken as simple ones
     * @throws SolverError if no motion fulfills G r >= g
     */
    Solution
    solve(const dealii::FullMatrix<double> &rates,
          const std::vector<double>        &given,
          const std::vector<double>        &free_motion,
          const std::vector<bool>          &bilateral = {}) const;

    /// Motion R^-1 f by forces f on the bodies.
    std::vector<double>
    response(const std::vector<double> &forces) const;

  private:
    /// R = L L^T
    dealii::LAPACKFullMatrix<double> factor;

    /// Rows of G L^-T: contacts by unknowns L^T r.
    std::vector<dealii::Vector<double>>
    scaled_rates(const dealii::FullMatrix<double> &rates) const;
  };
} // namespace Catena

#endif

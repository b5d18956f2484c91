#include <catena/base/exceptions.h>
#include <catena/particles/acting_contacts.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  ContactBlocks
  ContactBlocks::subset(const std::vector<bool> &set) const
  {
    ContactBlocks result;
    for (unsigned int c = 0; c < n_contacts(); ++c)
      if (set[c])
        {
          result.shares.push_back(shares[c]);
          result.given.push_back(given[c]);
        }
    if (result.n_contacts() > 0)
      result.rates.reinit(result.n_contacts(), rates.n());
    for (unsigned int c = 0, row = 0; c < n_contacts(); ++c)
      if (set[c])
        {
          for (unsigned int k = 0; k < rates.n(); ++k)
            result.rates(row, k) = rates(c, k);
          ++row;
        }
    return result;
  }



  ActingContacts::ActingContacts(const FullMatrix<double>  &rough_resistance,
                                 const ContactBlocks       &contacts,
                                 const std::vector<double> &motion,
                                 const std::vector<double> &forces)
    : contacts(contacts)
    , resistance(rough_resistance)
  {
    resistance.symmetrize();
    try
      {
        ContactForces test(resistance);
      }
    catch (const SolverError &)
      {
        const FullMatrix<double> indefinite(resistance);
        resistance = 0.;
        for (unsigned int k = 0; k < resistance.m(); ++k)
          resistance(k, k) = std::abs(indefinite(k, k));
      }
    choose(motion, forces);
  }



  std::vector<double>
  ActingContacts::pressure(const std::vector<double> &forces) const
  {
    std::vector<double> result(contacts.rates.n(), 0.);
    for (unsigned int c = 0; c < contacts.n_contacts(); ++c)
      for (unsigned int k = 0; k < result.size(); ++k)
        result[k] += contacts.shares[c] * forces[c] * contacts.rates(c, k);
    return result;
  }



  void
  ActingContacts::choose(const std::vector<double> &motion,
                         const std::vector<double> &forces)
  {
    const ContactForces       problem(resistance);
    const std::vector<double> response = problem.response(pressure(forces));
    std::vector<double>       free_motion(motion);
    for (unsigned int k = 0; k < motion.size(); ++k)
      free_motion[k] -= response[k];
    acting = problem.solve(contacts.rates, contacts.given, free_motion).active;
  }



  bool
  ActingContacts::are_found(const std::vector<double> &motion,
                            const std::vector<double> &forces,
                            const double               force_tolerance)
  {
    const ContactForces problem(resistance);
    bool                found = true;
    for (unsigned int c = 0; c < contacts.n_contacts(); ++c)
      if (acting[c])
        found = found && forces[c] >= -force_tolerance;
      else
        {
          std::vector<double> unit(contacts.n_contacts(), 0.);
          unit[c]             = force_tolerance;
          const auto response = problem.response(pressure(unit));
          double     rate = -contacts.given[c], smallest = 0.;
          for (unsigned int k = 0; k < motion.size(); ++k)
            {
              rate += contacts.rates(c, k) * motion[k];
              smallest -= contacts.rates(c, k) * response[k];
            }
          found = found && rate >= smallest;
        }
    if (!found)
      {
        learn(motion, pressure(forces));
        choose(motion, forces);
      }
    return found;
  }



  /**
   * With s and y the differences of motion and pressure between two solutions,
   * R - R s s^T R/(s.R s) + y y^T/(s.y).
   */
  void
  ActingContacts::learn(const std::vector<double> &motion,
                        const std::vector<double> &new_pressure)
  {
    const unsigned int n = motion.size();
    if (has_solution)
      {
        Vector<double> s(n), y(n), Rs(n);
        for (unsigned int k = 0; k < n; ++k)
          {
            s(k) = motion[k] - last_motion[k];
            y(k) = new_pressure[k] - last_pressure[k];
          }
        resistance.vmult(Rs, s);
        const double work = s * y, expected = s * Rs;
        // rounding and the tolerance of the solutions must not make it negative
        if (work > 1e-3 * expected)
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int l = 0; l < n; ++l)
              resistance(k, l) += y(k) * y(l) / work - Rs(k) * Rs(l) / expected;
      }
    last_motion   = motion;
    last_pressure = new_pressure;
    has_solution  = true;
  }
} // namespace Catena

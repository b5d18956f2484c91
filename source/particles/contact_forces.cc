#include <catena/base/exceptions.h>
#include <catena/particles/contact_forces.h>

#include <deal.II/lac/qr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// a contact of which no more than this is new depends on the active ones
    constexpr double dependent = 1e-7;

    /// rounding in the rate of a contact, in units of its terms
    constexpr double rounding = 1e-12;

    /**
     * The dual method in unknowns in which the resistance is the identity:
     * the smallest q with E q >= b.
     */
    class ActiveSet
    {
    public:
      ActiveSet(const std::vector<Vector<double>> &rows,
                const std::vector<double>         &bounds,
                const std::vector<double>         &sizes,
                const std::vector<bool>           &bilateral,
                const unsigned int                 n)
        : rows(rows)
        , bounds(bounds)
        , sizes(sizes)
        , bilateral(bilateral)
        , q(n)
      {}

      /**
       * @return a contact that cannot be fulfilled together with others, or
       * the number of contacts
       */
      unsigned int
      solve()
      {
        add_bilateral();
        const unsigned int max_entries = 100 * (q.size() + rows.size());
        for (unsigned int entry = 0; entry < max_entries; ++entry)
          {
            const unsigned int c = worst();
            if (c == rows.size() || !enter(c))
              return c;
          }
        throw SolverError("The contact forces did not converge.");
      }

      /**
       * The bilateral contact that keeps @p c most from opening, or the number
       * of contacts if there is none.
       */
      unsigned int
      blocking(const unsigned int c) const
      {
        const Split  split  = split_row(c);
        unsigned int result = rows.size();
        double       most   = 0.;
        for (unsigned int p = 0; p < active.size(); ++p)
          if (bilateral[active[p]] && split.coefficients(p) > most)
            {
              most   = split.coefficients(p);
              result = active[p];
            }
        return result;
      }

      /// Forces of all contacts and q, free of the rounding of the steps.
      void
      finish(ContactForces::Solution &solution, Vector<double> &motion) const
      {
        solution.forces.assign(rows.size(), 0.);
        solution.active.assign(rows.size(), false);
        motion.reinit(q.size());
        if (active.empty())
          return;
        Vector<double> values(active.size());
        for (unsigned int p = 0; p < active.size(); ++p)
          values(p) = bounds[active[p]];
        basis->solve(values, values, true);
        basis->multiply_with_Q(motion, values);
        basis->solve(values, values);
        for (unsigned int p = 0; p < active.size(); ++p)
          {
            const unsigned int c = active[p];
            solution.active[c]   = true;
            solution.forces[c] =
              bilateral[c] ? values(p) : std::max(0., values(p));
          }
      }

    private:
      const std::vector<Vector<double>> &rows;
      const std::vector<double>         &bounds;
      const std::vector<double>         &sizes; ///< of the terms of the bounds
      const std::vector<bool>           &bilateral;

      std::vector<unsigned int>           active;
      std::vector<double>                 forces;
      std::unique_ptr<QR<Vector<double>>> basis; ///< of the active rows
      Vector<double>                      q;
      double force = 0.; ///< of the contact that enters

      /// A row as a combination of active ones and a remainder normal to them.
      struct Split
      {
        Vector<double> coefficients, remainder;
        bool           is_new;
      };

      Split
      split_row(const unsigned int c) const
      {
        Split split{Vector<double>(active.size()), rows[c], true};
        if (!active.empty())
          {
            // twice is enough for orthogonality
            Vector<double> part(active.size()), sum(q.size());
            for (unsigned int pass = 0; pass < 2; ++pass)
              {
                basis->multiply_with_QT(part, split.remainder);
                basis->multiply_with_Q(sum, part);
                split.remainder -= sum;
                split.coefficients += part;
              }
            basis->solve(split.coefficients, split.coefficients);
          }
        split.is_new =
          split.remainder.l2_norm() > dependent * rows[c].l2_norm();
        return split;
      }

      /// Make equations of all bilateral contacts that are independent.
      void
      add_bilateral()
      {
        for (unsigned int c = 0; c < rows.size(); ++c)
          if (bilateral[c])
            {
              const Split split = split_row(c);
              if (split.is_new)
                {
                  step(split, missing(c) / split.remainder.norm_sqr());
                  append(c);
                }
            }
      }

      /// The contact that is violated most, or the number of contacts.
      unsigned int
      worst() const
      {
        unsigned int result = rows.size();
        double       most   = 0.;
        for (unsigned int c = 0; c < rows.size(); ++c)
          {
            const double size = rows[c].l2_norm();
            const double zero = rounding * (sizes[c] + size * q.l2_norm());
            if (missing(c) > zero && missing(c) > most * size && !is_active(c))
              {
                most   = size > 0. ? missing(c) / size :
                                     std::numeric_limits<double>::max();
                result = c;
              }
          }
        return result;
      }

      /**
       * Make an equation of contact @p c, let go those that attract.
       * @return whether this is possible
       */
      bool
      enter(const unsigned int c)
      {
        force = 0.;
        while (true)
          {
            const Split  split = split_row(c);
            const double full  = split.is_new ?
                                   missing(c) / split.remainder.norm_sqr() :
                                   std::numeric_limits<double>::infinity();
            double       t     = full;
            unsigned int first = active.size();
            for (unsigned int p = 0; p < active.size(); ++p)
              if (!bilateral[active[p]] && split.coefficients(p) > 0. &&
                  forces[p] < t * split.coefficients(p))
                {
                  t     = forces[p] / split.coefficients(p);
                  first = p;
                }
            if (std::isinf(t))
              return false;

            step(split, t);
            if (first == active.size())
              {
                append(c);
                return true;
              }
            remove(first);
          }
      }

      double
      missing(const unsigned int c) const
      {
        return bounds[c] - rows[c] * q;
      }

      bool
      is_active(const unsigned int c) const
      {
        return std::find(active.begin(), active.end(), c) != active.end();
      }

      /// Raise the force of the contact that enters, the active gaps unchanged.
      void
      step(const Split &split, const double t)
      {
        for (unsigned int p = 0; p < active.size(); ++p)
          forces[p] -= t * split.coefficients(p);
        force += t;
        if (split.is_new)
          q.add(t, split.remainder);
      }

      void
      append(const unsigned int c)
      {
        if (active.empty())
          basis = std::make_unique<QR<Vector<double>>>();
        basis->append_column(rows[c]);
        active.push_back(c);
        forces.push_back(force);
        force = 0.;
      }

      void
      remove(const unsigned int p)
      {
        active.erase(active.begin() + p);
        forces.erase(forces.begin() + p);
        if (!active.empty())
          basis->remove_column(p);
      }
    };
  } // namespace



  ContactForces::ContactForces(const FullMatrix<double> &resistance)
    : factor(resistance.m())
  {
    const unsigned int n = resistance.m();
    if (n == 0)
      return;
    FullMatrix<double> symmetric(resistance), lower(n);
    symmetric.symmetrize();
    try
      {
        lower.cholesky(symmetric);
      }
    catch (const FullMatrix<double>::ExcMatrixNotPositiveDefinite &)
      {
        throw SolverError("The resistance of the particles to their motion is "
                          "not positive definite: use a finer mesh.");
      }
    factor = lower;
    factor.set_property(LAPACKSupport::lower_triangular);
  }



  std::vector<Vector<double>>
  ContactForces::scaled_rates(const FullMatrix<double> &rates) const
  {
    std::vector<Vector<double>> rows(rates.m(), Vector<double>(factor.m()));
    for (unsigned int c = 0; c < rates.m(); ++c)
      {
        for (unsigned int k = 0; k < factor.m(); ++k)
          rows[c](k) = rates(c, k);
        factor.solve(rows[c]);
      }
    return rows;
  }



  ContactForces::Solution
  ContactForces::solve(const FullMatrix<double>  &rates,
                       const std::vector<double> &given,
                       const std::vector<double> &free_motion,
                       const std::vector<bool>   &bilateral) const
  {
    const unsigned int n = factor.m(), m = given.size();
    AssertDimension(free_motion.size(), n);
    Solution solution{free_motion, {}, {}};
    if (m == 0)
      return solution;

    const std::vector<Vector<double>> rows   = scaled_rates(rates);
    std::vector<double>               bounds = given, sizes(m);
    for (unsigned int c = 0; c < m; ++c)
      {
        sizes[c] = std::abs(given[c]);
        for (unsigned int k = 0; k < n; ++k)
          {
            bounds[c] -= rates(c, k) * free_motion[k];
            sizes[c] += std::abs(rates(c, k) * free_motion[k]);
          }
      }

    // without the bilateral contacts that stand in the way of others
    std::vector<bool> equations =
      bilateral.empty() ? std::vector<bool>(m, false) : bilateral;
    while (true)
      {
        ActiveSet          set(rows, bounds, sizes, equations, n);
        const unsigned int stuck = set.solve();
        if (stuck == m)
          {
            Vector<double> motion;
            set.finish(solution, motion);
            factor.solve(motion, true);
            for (unsigned int k = 0; k < n; ++k)
              solution.motion[k] += motion(k);
            return solution;
          }
        const unsigned int blocking = set.blocking(stuck);
        if (blocking == m)
          throw SolverError("The particles are jammed: no motion keeps all "
                            "their gaps open. Give them more room.");
        equations[blocking] = false;
      }
  }



  std::vector<double>
  ContactForces::response(const std::vector<double> &forces) const
  {
    Vector<double> motion(forces.begin(), forces.end());
    if (motion.size() > 0)
      {
        factor.solve(motion);
        factor.solve(motion, true);
      }
    return std::vector<double>(motion.begin(), motion.end());
  }
} // namespace Catena

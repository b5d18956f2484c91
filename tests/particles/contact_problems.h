#ifndef catena_tests_particles_contact_problems_h
#define catena_tests_particles_contact_problems_h

#include <catena/particles/contact_forces.h>

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    struct ContactProblem
    {
      dealii::FullMatrix<double> resistance, rates;
      std::vector<double>        given, free_motion;
    };



    /// A symmetric positive definite matrix with eigenvalues from 1.
    inline dealii::FullMatrix<double>
    random_resistance(const unsigned int n, std::mt19937 &random)
    {
      std::normal_distribution<double> normal;
      dealii::FullMatrix<double>       half(n), full(n);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          half(k, l) = normal(random);
      half.mTmult(full, half);
      for (unsigned int k = 0; k < n; ++k)
        full(k, k) += 1.;
      return full;
    }



    /// Contacts that some motion can keep, also if they are more than unknowns.
    inline ContactProblem
    random_problem(const unsigned int n,
                   const unsigned int m,
                   std::mt19937      &random)
    {
      std::normal_distribution<double> normal;
      ContactProblem                   problem;
      problem.resistance = random_resistance(n, random);
      problem.rates.reinit(m, n);
      problem.given.assign(m, 0.);
      std::vector<double> possible;
      for (unsigned int k = 0; k < n; ++k)
        {
          problem.free_motion.push_back(normal(random));
          possible.push_back(normal(random));
        }
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int k = 0; k < n; ++k)
          {
            problem.rates(c, k) = normal(random);
            problem.given[c] += problem.rates(c, k) * possible[k];
          }
      return problem;
    }



    /// By how much the conditions of a solution are missed.
    struct ComplementarityErrors
    {
      double balance = 0., rate = 0., force = 0., product = 0.;

      void
      add(const ComplementarityErrors &other)
      {
        balance = std::max(balance, other.balance);
        rate    = std::max(rate, other.rate);
        force   = std::max(force, other.force);
        product = std::max(product, other.product);
      }

      double
      largest() const
      {
        return std::max({balance, rate, force, product});
      }
    };



    inline ComplementarityErrors
    complementarity_errors(const ContactProblem          &problem,
                           const ContactForces::Solution &solution)
    {
      const unsigned int n = problem.free_motion.size(),
                         m = problem.given.size();
      ComplementarityErrors errors;
      for (unsigned int k = 0; k < n; ++k)
        {
          double sum = 0.;
          for (unsigned int l = 0; l < n; ++l)
            sum += problem.resistance(k, l) *
                   (solution.motion[l] - problem.free_motion[l]);
          for (unsigned int c = 0; c < m; ++c)
            sum -= problem.rates(c, k) * solution.forces[c];
          errors.balance = std::max(errors.balance, std::abs(sum));
        }
      for (unsigned int c = 0; c < m; ++c)
        {
          double rate = -problem.given[c];
          for (unsigned int k = 0; k < n; ++k)
            rate += problem.rates(c, k) * solution.motion[k];
          const double force = solution.forces[c];
          errors.rate        = std::max(errors.rate, -rate);
          errors.force       = std::max(errors.force, -force);
          errors.product     = std::max(errors.product, std::abs(force * rate));
        }
      return errors;
    }



    /**
     * The motion closest to the free one of those that fulfill the equations
     * of any set of contacts and violate no other contact: all sets are tried.
     */
    inline std::vector<double>
    best_of_all_sets(const ContactProblem &problem)
    {
      const unsigned int n         = problem.free_motion.size(),
                         m         = problem.given.size();
      double              smallest = std::numeric_limits<double>::max();
      std::vector<double> best;
      for (unsigned int set = 0; set < (1U << m); ++set)
        {
          std::vector<unsigned int> members;
          for (unsigned int c = 0; c < m; ++c)
            if (set & (1U << c))
              members.push_back(c);
          const unsigned int size = n + members.size();
          if (members.size() > n)
            continue;

          // R r - G^T F = R r_0, G r = g
          dealii::FullMatrix<double> matrix(size);
          dealii::Vector<double>     rhs(size), solution(size);
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int l = 0; l < n; ++l)
              {
                matrix(k, l) = problem.resistance(k, l);
                rhs(k) += problem.resistance(k, l) * problem.free_motion[l];
              }
          for (unsigned int p = 0; p < members.size(); ++p)
            {
              for (unsigned int k = 0; k < n; ++k)
                {
                  matrix(n + p, k) = problem.rates(members[p], k);
                  matrix(k, n + p) = -problem.rates(members[p], k);
                }
              rhs(n + p) = problem.given[members[p]];
            }
          matrix.gauss_jordan();
          matrix.vmult(solution, rhs);

          bool possible = true;
          for (unsigned int c = 0; c < m; ++c)
            {
              double rate = -problem.given[c];
              for (unsigned int k = 0; k < n; ++k)
                rate += problem.rates(c, k) * solution(k);
              possible = possible && rate > -1e-8;
            }
          double distance = 0.;
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int l = 0; l < n; ++l)
              distance += problem.resistance(k, l) *
                          (solution(k) - problem.free_motion[k]) *
                          (solution(l) - problem.free_motion[l]);
          if (possible && distance < smallest)
            {
              smallest = distance;
              best.assign(solution.begin(), solution.begin() + n);
            }
        }
      return best;
    }



    /// Spheres of diameter one that touch each other.
    struct Cluster
    {
      std::string                   name;
      std::vector<dealii::Point<3>> centres;
      unsigned int                  n_contacts;
    };



    inline std::vector<Cluster>
    clusters()
    {
      const double s = std::sqrt(0.5);
      Cluster      tetrahedron{"tetrahedron",
                          {dealii::Point<3>(s / 2., s / 2., s / 2.),
                                dealii::Point<3>(s / 2., -s / 2., -s / 2.),
                                dealii::Point<3>(-s / 2., s / 2., -s / 2.),
                                dealii::Point<3>(-s / 2., -s / 2., s / 2.)},
                          6};

      // in face-centred cubic packing, 36 contacts and 33 relative freedoms
      Cluster cuboctahedron{"13 spheres", {dealii::Point<3>()}, 36};
      for (unsigned int d = 0; d < 3; ++d)
        for (const double a : {-s, s})
          for (const double b : {-s, s})
            {
              dealii::Point<3> p;
              p[(d + 1) % 3] = a;
              p[(d + 2) % 3] = b;
              cuboctahedron.centres.push_back(p);
            }

      Cluster square{"square", {}, 4};
      for (unsigned int i = 0; i < 4; ++i)
        square.centres.emplace_back(i % 2, i / 2, 0.);
      Cluster row{"row of five", {}, 4};
      for (unsigned int i = 0; i < 5; ++i)
        row.centres.emplace_back(i, 0., 0.);
      return {tetrahedron, cuboctahedron, square, row};
    }



    /**
     * A cluster in a strong shear flow, as points that only translate and
     * resist that in any way.
     */
    inline ContactProblem
    sheared_cluster(const std::vector<dealii::Point<3>> &centres,
                    std::mt19937                        &random)
    {
      const unsigned int n = 3 * centres.size();
      ContactProblem     problem;
      problem.resistance = random_resistance(n, random);
      std::vector<std::vector<double>> rows;
      for (unsigned int i = 0; i < centres.size(); ++i)
        {
          for (unsigned int d = 0; d < 3; ++d)
            problem.free_motion.push_back(d == 0 ? -centres[i][1] : 0.);
          for (unsigned int j = 0; j < i; ++j)
            if (centres[i].distance(centres[j]) < 1. + 1e-12)
              {
                rows.emplace_back(n, 0.);
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    rows.back()[3 * i + d] = centres[i][d] - centres[j][d];
                    rows.back()[3 * j + d] = centres[j][d] - centres[i][d];
                  }
              }
        }
      problem.rates.reinit(rows.size(), n);
      for (unsigned int c = 0; c < rows.size(); ++c)
        for (unsigned int k = 0; k < n; ++k)
          problem.rates(c, k) = rows[c][k];
      problem.given.assign(rows.size(), 0.);
      return problem;
    }
  } // namespace Tests
} // namespace Catena

#endif

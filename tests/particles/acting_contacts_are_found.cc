// The contacts that act are found for bodies whose resistance is known only
// roughly, from solutions with one set of contacts after the other: in networks
// with redundant contacts, under any forces, whatever the rough resistance. A
// solution that is known needs no second one.

#include <catena/particles/acting_contacts.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../tests.h"

#include "../print.h"
#include "contact_problems.h"

using namespace dealii;
using namespace Catena;

struct State
{
  std::vector<double> motion, forces;
};



/// The exact system with the contacts of a set as equations.
State
solve_with(const Tests::ContactProblem &problem, const std::vector<bool> &set)
{
  ContactBlocks       all{problem.rates,
                    std::vector<double>(set.size(), 1.),
                    problem.given};
  const ContactBlocks equations = all.subset(set);
  const auto          solution =
    ContactForces(problem.resistance)
      .solve(equations.rates,
             equations.given,
             problem.free_motion,
             std::vector<bool>(equations.n_contacts(), true));
  State state{solution.motion, std::vector<double>(set.size(), 0.)};
  for (unsigned int c = 0, row = 0; c < set.size(); ++c)
    if (set[c])
      state.forces[c] = solution.forces[row++];
  return state;
}



/**
 * From @p state to the solution.
 * @return the number of solutions it took, at most 100
 */
unsigned int
find(const Tests::ContactProblem &problem,
     const FullMatrix<double>    &rough_resistance,
     State                       &state)
{
  const ContactBlocks contacts{problem.rates,
                               std::vector<double>(problem.given.size(), 1.),
                               problem.given};
  ActingContacts acting(rough_resistance, contacts, state.motion, state.forces);
  for (unsigned int n = 1; n < 100; ++n)
    {
      state = solve_with(problem, acting.set());
      if (acting.are_found(state.motion, state.forces, 1e-9))
        return n;
    }
  return 100;
}



/**
 * A cluster under random forces, with different resistances of its spheres and
 * that of the fluid in the gaps.
 */
Tests::ContactProblem
pushed_cluster(const Tests::Cluster &cluster,
               const double          lubrication,
               std::mt19937         &random)
{
  std::normal_distribution<double> normal;
  Tests::ContactProblem            problem =
    Tests::sheared_cluster(cluster.centres, random);
  const unsigned int n = problem.free_motion.size();
  problem.resistance   = 0.;
  std::vector<double> forces;
  for (unsigned int k = 0; k < n; ++k)
    {
      problem.resistance(k, k) = std::exp(0.5 * normal(random));
      forces.push_back(normal(random));
    }
  for (unsigned int c = 0; c < problem.given.size(); ++c)
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        problem.resistance(k, l) +=
          lubrication * problem.rates(c, k) * problem.rates(c, l);
  problem.free_motion = ContactForces(problem.resistance).response(forces);
  return problem;
}



void
check(Tests::Claims            &claims,
      const std::string        &name,
      const Tests::Cluster     &cluster,
      const double              lubrication,
      const FullMatrix<double> &rough_resistance,
      const unsigned int        most_solutions)
{
  std::mt19937 random(1);
  unsigned int most = 0, sum = 0, most_again = 0;
  double       difference = 0.;
  for (unsigned int trial = 0; trial < 50; ++trial)
    {
      const auto problem = pushed_cluster(cluster, lubrication, random);
      State      state{std::vector<double>(problem.free_motion.size(), 0.),
                  std::vector<double>(problem.given.size(), 0.)};
      const unsigned int n = find(problem, rough_resistance, state);
      most                 = std::max(most, n);
      sum += n;
      const auto exact =
        ContactForces(problem.resistance)
          .solve(problem.rates, problem.given, problem.free_motion);
      for (unsigned int k = 0; k < state.motion.size(); ++k)
        difference =
          std::max(difference, std::abs(state.motion[k] - exact.motion[k]));
      most_again = std::max(most_again, find(problem, rough_resistance, state));
    }
  Tests::print(name, ": ", sum / 50., " solutions on average");
  claims.at_most(name + ": solutions", most, most_solutions);
  claims.at_most(name + ": the motion is exact", difference, 1e-8);
  claims.near(name + ": known solutions need no other", most_again, 1., 0.);
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const auto &cluster : Tests::clusters())
      {
        const unsigned int       n          = 3 * cluster.centres.size();
        const FullMatrix<double> one        = IdentityMatrix(n);
        FullMatrix<double>       indefinite = one;
        for (unsigned int k = 0; k < n; ++k)
          indefinite(k, n - 1 - k) = 2.;

        check(claims, cluster.name + ", far apart", cluster, 0., one, 5);
        check(claims, cluster.name + ", lubricated", cluster, 10., one, 15);
        check(claims,
              cluster.name + ", from an indefinite resistance",
              cluster,
              1.,
              indefinite,
              6);
      }
  });
}

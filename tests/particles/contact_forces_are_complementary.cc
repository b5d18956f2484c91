// Contact forces and motion fulfill all conditions of the complementarity
// problem: for random bodies, where they agree with the best of all sets of
// contacts tried one by one, with contacts named twice, for contacts without
// force, and for clusters with more contacts than freedoms.

#include <catena/base/exceptions.h>
#include <catena/particles/contact_forces.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../tests.h"

#include "contact_problems.h"

using namespace dealii;
using namespace Catena;

void
check(Tests::Claims                 &claims,
      const std::string             &name,
      const Tests::ContactProblem   &problem,
      const ContactForces::Solution &solution)
{
  const auto errors = Tests::complementarity_errors(problem, solution);
  claims.at_most(name + ": forces balance", errors.balance, 1e-10);
  claims.at_most(name + ": no gap closes", errors.rate, 1e-10);
  claims.at_most(name + ": no force attracts", errors.force, 0.);
  claims.at_most(name + ": open gaps have no force", errors.product, 1e-10);
}



void
random_bodies(Tests::Claims &claims)
{
  std::mt19937                 random(1);
  double                       difference = 0.;
  Tests::ComplementarityErrors worst;
  unsigned int                 most_active = 0, n_free = 0;
  for (unsigned int trial = 0; trial < 200; ++trial)
    {
      const unsigned int  n = 2 + trial % 7, m = 1 + trial % 8;
      const auto          problem = Tests::random_problem(n, m, random);
      const ContactForces solver(problem.resistance);
      const auto          solution =
        solver.solve(problem.rates, problem.given, problem.free_motion);
      const auto motion = Tests::best_of_all_sets(problem);
      for (unsigned int k = 0; k < n; ++k)
        difference =
          std::max(difference, std::abs(solution.motion[k] - motion[k]));
      worst.add(Tests::complementarity_errors(problem, solution));
      const unsigned int n_active =
        std::count(solution.active.begin(), solution.active.end(), true);
      most_active = std::max(most_active, n_active);
      n_free += n_active == 0;
    }
  claims.at_most("random: the motion is that of the best set",
                 difference,
                 1e-9);
  claims.at_most("random: all conditions hold", worst.largest(), 1e-10);
  claims.at_least("random: many contacts act", most_active, 5);
  claims.at_least("random: some have none that acts", n_free, 1);
}



/// Contacts that are named several times, or sums of others.
void
dependent_contacts(Tests::Claims &claims)
{
  std::mt19937                 random(2);
  Tests::ComplementarityErrors worst;
  double                       difference = 0.;
  bool                         only_once  = true;
  for (unsigned int trial = 0; trial < 50; ++trial)
    {
      const unsigned int n = 6, m = 5;
      const auto         problem = Tests::random_problem(n, m, random);
      auto               twice   = problem;
      twice.rates.reinit(3 * m, n);
      twice.given.resize(3 * m);
      for (unsigned int c = 0; c < m; ++c)
        {
          const unsigned int d = (c + 1) % m;
          for (unsigned int k = 0; k < n; ++k)
            {
              twice.rates(c, k)     = problem.rates(c, k);
              twice.rates(m + c, k) = problem.rates(c, k);
              twice.rates(2 * m + c, k) =
                problem.rates(c, k) + problem.rates(d, k);
            }
          twice.given[m + c]     = problem.given[c];
          twice.given[2 * m + c] = problem.given[c] + problem.given[d];
        }
      const ContactForces solver(problem.resistance);
      const auto          once =
        solver.solve(problem.rates, problem.given, problem.free_motion);
      const auto solution =
        solver.solve(twice.rates, twice.given, twice.free_motion);
      worst.add(Tests::complementarity_errors(twice, solution));
      for (unsigned int k = 0; k < n; ++k)
        difference =
          std::max(difference, std::abs(solution.motion[k] - once.motion[k]));
      for (unsigned int c = 0; c < m; ++c)
        only_once =
          only_once && !(solution.active[c] && solution.active[m + c]);
    }
  claims.at_most("dependent: all conditions hold", worst.largest(), 1e-10);
  claims.at_most("dependent: they change nothing", difference, 1e-10);
  claims.holds("dependent: none acts twice", only_once);
}



/// The free motion leaves the gaps as they are: no force is needed.
void
forceless_contacts(Tests::Claims &claims)
{
  std::mt19937 random(3);
  auto         problem = Tests::random_problem(6, 5, random);
  for (unsigned int c = 0; c < 5; ++c)
    {
      problem.given[c] = 0.;
      for (unsigned int k = 0; k < 6; ++k)
        problem.given[c] += problem.rates(c, k) * problem.free_motion[k];
    }
  const ContactForces solver(problem.resistance);
  const auto          solution =
    solver.solve(problem.rates, problem.given, problem.free_motion);
  check(claims, "without force", problem, solution);
  claims.holds("without force: none acts",
               std::count(solution.active.begin(),
                          solution.active.end(),
                          true) == 0 &&
                 solution.motion == problem.free_motion);

  // the same, though all are equations
  const auto held = solver.solve(problem.rates,
                                 problem.given,
                                 problem.free_motion,
                                 std::vector<bool>(5, true));
  claims.at_most("without force: nor if all are held",
                 Tests::complementarity_errors(problem, held).largest(),
                 1e-12);
}



/// Bilateral contacts hold in attraction, dependent ones do no harm.
void
bilateral_contacts(Tests::Claims &claims)
{
  std::mt19937 random(4);
  double       rate_error = 0., most_attraction = 0.;
  for (unsigned int trial = 0; trial < 50; ++trial)
    {
      auto problem = Tests::random_problem(6, 6, random);
      for (unsigned int k = 0; k < 6; ++k)
        problem.rates(2, k) = problem.rates(0, k) - problem.rates(1, k);
      problem.given[2] = problem.given[0] - problem.given[1];
      const ContactForces solver(problem.resistance);
      const auto          solution =
        solver.solve(problem.rates,
                     problem.given,
                     problem.free_motion,
                     {true, true, true, true, false, false});
      for (unsigned int c = 0; c < 6; ++c)
        {
          double rate = -problem.given[c];
          for (unsigned int k = 0; k < 6; ++k)
            rate += problem.rates(c, k) * solution.motion[k];
          rate_error = std::max(rate_error, c < 4 ? std::abs(rate) : -rate);
          if (c < 4)
            most_attraction = std::max(most_attraction, -solution.forces[c]);
          else
            rate_error = std::max(rate_error, -solution.forces[c]);
        }
    }
  claims.at_most("bilateral: gaps are held", rate_error, 1e-10);
  claims.at_least("bilateral: also in attraction", most_attraction, 0.1);
}



void
clusters(Tests::Claims &claims)
{
  std::mt19937 random(5);
  for (const auto &cluster : Tests::clusters())
    {
      const auto problem = Tests::sheared_cluster(cluster.centres, random);
      const ContactForces solver(problem.resistance);
      const auto          solution =
        solver.solve(problem.rates, problem.given, problem.free_motion);
      claims.near(cluster.name + ": contacts",
                  problem.given.size(),
                  cluster.n_contacts,
                  0.);
      check(claims, cluster.name + ", sheared", problem, solution);

      // forces towards the middle press all together
      auto                pressed = problem;
      std::vector<double> forces;
      Tensor<1, 3>        middle;
      for (const auto &centre : cluster.centres)
        middle += centre / double(cluster.centres.size());
      for (const auto &centre : cluster.centres)
        for (unsigned int d = 0; d < 3; ++d)
          forces.push_back(middle[d] - centre[d]);
      pressed.free_motion = solver.response(forces);
      const auto rigid =
        solver.solve(pressed.rates, pressed.given, pressed.free_motion);
      check(claims, cluster.name + ", pressed", pressed, rigid);
      double moved = 0.;
      for (const double value : rigid.motion)
        moved = std::max(moved, std::abs(value));
      claims.at_most(cluster.name + ", pressed: nothing moves", moved, 1e-10);
      claims.at_least(cluster.name + ", pressed: forces",
                      *std::max_element(rigid.forces.begin(),
                                        rigid.forces.end()),
                      0.1);
    }
}



void
failures(Tests::Claims &claims)
{
  const auto refused = [](const auto &action) {
    try
      {
        action();
        return false;
      }
    catch (const SolverError &)
      {
        return true;
      }
  };
  FullMatrix<double> indefinite(2);
  indefinite(0, 0) = 1.;
  indefinite(1, 1) = -1.;
  claims.holds("a resistance that is not positive is refused",
               refused([&]() { ContactForces solver(indefinite); }));

  // a body between two walls that both demand room
  FullMatrix<double> one(1), rates(2, 1);
  one(0, 0)   = 1.;
  rates(0, 0) = 1.;
  rates(1, 0) = -1.;
  claims.holds("jammed bodies are an error", refused([&]() {
                 ContactForces(one).solve(rates, {0.1, 0.1}, {0.});
               }));
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    random_bodies(claims);
    dependent_contacts(claims);
    forceless_contacts(claims);
    bilateral_contacts(claims);
    clusters(claims);
    failures(claims);
  });
}

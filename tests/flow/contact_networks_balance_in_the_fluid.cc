// Networks with redundant contacts in a sheared fluid, pressed by forces and
// not: the contacts repel and their gaps do not close, open ones carry no
// force, and the forces on every particle balance. A solution is a first guess
// that needs no other solve. Half a tetrahedron, of which two spheres are in
// the mirror plane and one touches its image, is like the whole one.

#include <catena/particles/contacts.h>

#include <algorithm>
#include <cmath>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

constexpr double minimal_gap = 0.05, distance = 2. + 2. * minimal_gap;

/// F_r by candidate of a network with forces towards its middle, or none.
template <int dim>
std::vector<double>
check(Tests::Claims     &claims,
      const std::string &name,
      const Scene<dim>  &scene,
      const unsigned int n_contacts,
      const double       pressing_force)
{
  const Contacts<dim>       contacts(scene, minimal_gap);
  Tests::StokesProblem<dim> problem(scene, Tests::resolution(12, 1), 1e-8);
  const auto candidates          = contacts.candidates(problem.configuration);
  const RigidBodies<dim> &bodies = problem.bodies;
  const unsigned int      n      = bodies.n_unknowns();
  claims.near(name + ": contacts", candidates.size(), n_contacts, 0.);

  std::vector<double> external_forces(n, 0.);
  for (unsigned int k = 0; k < n; ++k)
    if (!bodies.unknown(k).rotation)
      external_forces[k] =
        -pressing_force * scene.particles[bodies.unknown(k).particle]
                            .centre[bodies.unknown(k).axis];
  const unsigned int iterations = problem.solve(external_forces, candidates);
  const auto        &forces     = problem.fields.contact_forces;

  const auto motions      = bodies.values(problem.fields.motions);
  auto       total_forces = external_forces;
  double     rate_error = 0., product = 0.;
  for (unsigned int c = 0; c < candidates.size(); ++c)
    {
      const auto row  = candidates[c].rate(bodies);
      double     rate = 0.;
      for (unsigned int k = 0; k < n; ++k)
        {
          rate += row[k] * motions[k];
          total_forces[k] += candidates[c].meshed_share * forces[c] * row[k] /
                             bodies.meshed_share(k);
        }
      rate_error = std::max(rate_error, -rate);
      product    = std::max(product, std::abs(rate * forces[c]));
    }
  const auto needed    = problem.forces();
  double     imbalance = 0.;
  for (unsigned int k = 0; k < n; ++k)
    imbalance = std::max(imbalance, std::abs(needed[k] - total_forces[k]));

  claims.at_least(name + ": no contact attracts",
                  *std::min_element(forces.begin(), forces.end()),
                  0.);
  claims.at_least(name + ": some repel",
                  *std::max_element(forces.begin(), forces.end()),
                  1.);
  claims.at_most(name + ": no gap closes", rate_error, 1e-5);
  claims.at_most(name + ": open gaps have no force", product, 1e-5);
  claims.at_most(name + ": forces balance", imbalance, 1e-5);
  claims.near(name + ": the solution is a first guess",
              problem.solve(external_forces, candidates),
              0.,
              0.);
  for (const double force : forces)
    Tests::print("  F_r ", force);
  Tests::print("  ", iterations, " iterations");
  return forces;
}



Scene<2>
seven_discs()
{
  Scene<2> scene;
  scene.length = 14.;
  scene.height = 10.;
  scene.particles.push_back({Point<2>()});
  for (unsigned int i = 0; i < 6; ++i)
    scene.particles.push_back({Tests::polar<2>(distance, 10. + 60. * i)});
  return scene;
}



Scene<3>
tetrahedron(const Symmetry symmetry)
{
  const double half = distance / 2.;
  Scene<3>     scene;
  scene.length                 = 9.;
  scene.height                 = 8.;
  scene.width                  = 9.;
  scene.symmetry               = symmetry;
  scene.particles              = {{half * Tests::polar<3>(1., 20.)},
                                  {half * Tests::polar<3>(1., 200.)},
                                  {std::sqrt(2.) * half * Tests::polar<3>(1., 110.)}};
  scene.particles[2].centre[2] = half;
  if (symmetry == Symmetry::none)
    {
      scene.particles.push_back(scene.particles[2]);
      scene.particles[3].centre[2] = -half;
    }
  return scene;
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check(claims, "seven discs", seven_discs(), 12, 0.);
    check(claims, "seven discs, pressed", seven_discs(), 12, 5.);

    for (const double force : {0., 10.})
      {
        const std::string suffix     = force > 0. ? ", pressed" : "";
        const auto        half       = check(claims,
                                "half a tetrahedron" + suffix,
                                tetrahedron(Symmetry::half),
                                4,
                                force);
        const auto        whole      = check(claims,
                                 "a tetrahedron" + suffix,
                                 tetrahedron(Symmetry::none),
                                 6,
                                 force);
        double            difference = 0.;
        // their contacts are 01, 02, 12, 33' and 01, 02, 12, 03, 13, 23
        for (const auto &pair :
             {std::make_pair(0, 0), {1, 1}, {2, 2}, {1, 3}, {2, 4}, {3, 5}})
          difference =
            std::max(difference,
                     std::abs(half[pair.first] - whole[pair.second]));
        claims.at_most("half and whole agree" + suffix,
                       difference /
                         *std::max_element(whole.begin(), whole.end()),
                       0.05);
      }
  });
}

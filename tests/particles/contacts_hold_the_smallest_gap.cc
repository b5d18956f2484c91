// A pair of surfaces closer than the smallest gap is moved to exactly that gap
// along its line of centres; a wider one is left alone. Networks of any number
// of contacts, walls and mirror planes are restored at once.

#include <algorithm>
#include <cmath>
#include <random>

#include "../tests.h"

#include "contact_problems.h"
#include "scenes.h"

using namespace dealii;
using namespace Catena;

template <int dim>
Point<dim>
middle(const Configuration<dim> &configuration)
{
  Tensor<1, dim> sum;
  for (const auto &centre : configuration.centres)
    sum += centre;
  return Point<dim>(sum / double(configuration.centres.size()));
}

template <int dim>
double
largest_move(const Configuration<dim> &a, const Configuration<dim> &b)
{
  double largest = 0.;
  for (unsigned int i = 0; i < a.centres.size(); ++i)
    largest = std::max(largest, a.centres[i].distance(b.centres[i]));
  return largest;
}

template <int dim>
void
one_pair(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";

  // a little more and a little less than the smallest gap
  for (const auto &wide : Tests::pairs_at<dim>(Tests::held_distance + 1e-9))
    {
      Contacts<dim> contacts(wide.scene, Tests::minimal_gap);
      const auto    before = Tests::configuration_of(wide.scene);
      auto          after  = before;
      contacts.enforce(after);
      claims.holds(wide.name + ": a wider gap is left alone" + suffix,
                   contacts.candidates(after).empty() &&
                     largest_move(before, after) == 0.);
      claims.near(wide.name + ": smallest gap in diameters" + suffix,
                  contacts.smallest_gap(after),
                  Tests::minimal_gap + 0.5e-9,
                  1e-13);
    }

  for (const auto &narrow : Tests::pairs_at<dim>(Tests::held_distance - 0.01))
    {
      Contacts<dim> contacts(narrow.scene, Tests::minimal_gap);
      const auto    before = Tests::configuration_of(narrow.scene);
      auto          after  = before;
      contacts.enforce(after);
      claims.holds(narrow.name + ": a narrower gap is a contact" + suffix,
                   contacts.candidates(after).size() == 1);
      claims.near(narrow.name + ": it is exactly the smallest one" + suffix,
                  contacts.smallest_gap(after),
                  Tests::minimal_gap,
                  1e-13);

      // each side moves by half of what is missing; all of it beside the axis
      const bool on_axis = narrow.scene.particles[0].on_axis;
      claims.near(narrow.name + ": no farther than needed" + suffix,
                  largest_move(before, after),
                  on_axis ? 0.01 : 0.005,
                  1e-13);
      if (on_axis)
        claims.holds(narrow.name + ": that one stays" + suffix,
                     after.centres[0] == Point<dim>());
      if (!narrow.scene.rotational())
        claims.near(narrow.name + ": their middle stays" + suffix,
                    middle(after).distance(middle(before)),
                    0.,
                    1e-13);

      const Tensor<1, dim> direction = contacts.candidates(after)[0].direction;
      claims.near(narrow.name + ": the line of centres stays" + suffix,
                  std::abs(std::cos(0.3) * direction[0] +
                           std::sin(0.3) * direction[1]),
                  1.,
                  1e-13);
    }
}

void
different_radii(Tests::Claims &claims)
{
  const auto  scene = Tests::scene_of<3>(Symmetry::none,
                                        {{Point<3>(0., 0., 1.), 0.5},
                                          {Point<3>(2.5, 0., 1.), 2.}});
  Contacts<3> contacts(scene, Tests::minimal_gap);
  auto        after = Tests::configuration_of(scene);
  contacts.enforce(after);
  claims.near("spheres of different radii are held at the gap of 2 a d_min",
              after.centres[0].distance(after.centres[1]),
              2.5 + 2. * Tests::minimal_gap,
              1e-13);
}

/// Rows and rings of particles, where each move changes the next gap.
void
networks(Tests::Claims &claims)
{
  struct Network
  {
    std::string  name;
    Scene<3>     scene;
    unsigned int n_contacts;
  };

  std::vector<Particle<3>> row, ring;
  for (unsigned int i = 0; i < 6; ++i)
    {
      const double angle = i * numbers::PI / 3.;
      row.push_back({Point<3>(2.01 * i - 5., 0.1 * i, 0.02 * i * i)});
      ring.push_back(
        {Point<3>(2.02 * std::cos(angle), 2.02 * std::sin(angle), 0.)});
    }
  ring.push_back({Point<3>()});

  for (const auto &network :
       {Network{"row of six", Tests::scene_of<3>(Symmetry::none, row), 5},
        Network{"ring of six about one",
                Tests::scene_of<3>(Symmetry::none, ring),
                12},
        Network{"string of five in the quarter",
                Tests::scene_of<3>(Symmetry::quarter,
                                   {{Point<3>(), 1., true},
                                    {Point<3>(2.01, 0.3, 0.)},
                                    {Point<3>(4.02, 0.5, 0.)}}),
                2}})
    {
      Contacts<3> contacts(network.scene, Tests::minimal_gap);
      auto        after = Tests::configuration_of(network.scene);
      contacts.enforce(after);
      claims.near(network.name + ": contacts",
                  contacts.candidates(after).size(),
                  network.n_contacts,
                  0.);

      double     error = 0.;
      const auto found = contacts.candidates(after);
      for (const auto &contact : found)
        error = std::max(error,
                         std::abs(after.centres[contact.i].distance(
                                    after.centres[contact.j]) -
                                  Tests::held_distance));
      claims.at_most(network.name + ": all gaps are exact", error, 1e-12);
      claims.near(network.name + ": no gap is smaller",
                  contacts.smallest_gap(after),
                  Tests::minimal_gap,
                  1e-12);
    }
}

/**
 * Clusters with redundant contacts, shaken: no gap is left below the smallest
 * one, and of the held ones all are exact that can be at the same time.
 */
void
shaken_clusters(Tests::Claims &claims)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> shake(-0.02, 0.02);
  for (const auto &cluster : Tests::clusters())
    {
      std::vector<Particle<3>> particles;
      for (const auto &centre : cluster.centres)
        particles.push_back({Point<3>(Tests::held_distance * centre)});
      const auto   scene = Tests::scene_of<3>(Symmetry::none, particles);
      Contacts<3>  contacts(scene, Tests::minimal_gap);
      const auto   start      = Tests::configuration_of(scene);
      const auto   candidates = contacts.candidates(start);
      unsigned int fewest     = candidates.size();
      double       smallest = 1., smallest_free = 1., largest = 0.;
      for (unsigned int trial = 0; trial < 20; ++trial)
        {
          auto shaken = start;
          for (auto &centre : shaken.centres)
            for (unsigned int d = 0; d < 3; ++d)
              centre[d] += shake(random);
          contacts.remember(candidates,
                            std::vector<double>(candidates.size(), 0.));
          auto free = shaken;
          contacts.enforce(free);
          smallest_free = std::min(smallest_free, contacts.smallest_gap(free));

          contacts.remember(candidates,
                            std::vector<double>(candidates.size(), 1.));
          auto held = shaken;
          contacts.enforce(held);
          smallest = std::min(smallest, contacts.smallest_gap(held));
          fewest =
            std::min<unsigned int>(fewest, contacts.candidates(held).size());
          for (unsigned int i = 0; i < held.centres.size(); ++i)
            largest =
              std::max(largest, held.centres[i].distance(start.centres[i]));
        }
      claims.near(cluster.name + ": contacts",
                  candidates.size(),
                  cluster.n_contacts,
                  0.);
      claims.near(cluster.name + ", shaken: no gap is smaller",
                  smallest_free,
                  Tests::minimal_gap,
                  1e-13);
      claims.near(cluster.name + ", held: no gap is smaller",
                  smallest,
                  Tests::minimal_gap,
                  1e-13);
      const bool redundant = cluster.n_contacts > 3 * particles.size() - 6;
      claims.at_least(cluster.name + ", held: gaps that are exact",
                      fewest,
                      (redundant ? 0.8 : 1.) * cluster.n_contacts);
      claims.at_most(cluster.name + ", held: none moves far", largest, 0.1);
    }
}



/// Particles of different sizes in a corner, on a mirror plane and on the axis.
void
crowd(Tests::Claims &claims)
{
  auto scene   = Tests::scene_of<3>(Symmetry::quarter,
                                  {{Point<3>(), 1., true},
                                     {Point<3>(1.9, 0.1, 0.), 1.},
                                     {Point<3>(1.2, 0.5, 2.), 1.5},
                                     {Point<3>(3.4, 0.9, 1.), 0.7},
                                     {Point<3>(1.2, 2.5, 0.), 0.8}});
  scene.height = 6.6;
  scene.width  = 7.1;
  const Contacts<3> contacts(scene, Tests::minimal_gap);
  auto              after = Tests::configuration_of(scene);
  contacts.enforce(after);
  const auto &x = after.centres;

  claims.holds("crowd: the one on the axis stays", x[0] == Point<3>());
  claims.holds("crowd: those in the mirror plane stay in it",
               x[1][2] == 0. && x[4][2] == 0.);
  claims.near("crowd: no gap is smaller",
              contacts.smallest_gap(after),
              Tests::minimal_gap,
              1e-13);
  double wall = 1., mirror = 1.;
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      const double radius = scene.particles[i].radius;
      wall   = std::min(wall, scene.height / 2. - std::abs(x[i][1]) - radius);
      mirror = std::min(mirror, scene.width / 2. - x[i][2] - radius);
      if (i == 2 || i == 3)
        mirror = std::min(mirror, x[i][2] - radius);
    }
  claims.near("crowd: nor at a wall", wall, 2. * Tests::minimal_gap, 1e-13);
  claims.near("crowd: nor with a mirror image",
              mirror,
              Tests::minimal_gap,
              1e-13);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    one_pair<2>(claims);
    one_pair<3>(claims);
    different_radii(claims);
    networks(claims);
    shaken_clusters(claims);
    crowd(claims);
  });
}

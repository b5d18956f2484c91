// A pair of surfaces closer than the smallest gap is held and moved to exactly
// that gap along its line of centres; a wider one is left alone.

#include <algorithm>
#include <cmath>

#include "../tests.h"

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
                   contacts.n_held() == 0 && contacts.held(after).empty() &&
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
      claims.holds(narrow.name + ": a narrower gap is held" + suffix,
                   contacts.n_held() == 1 && contacts.held(after).size() == 1);
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

      const Tensor<1, dim> direction = contacts.held(after)[0].direction;
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
                  contacts.n_held(),
                  network.n_contacts,
                  0.);

      double     error = 0.;
      const auto held  = contacts.held(after);
      for (const auto &contact : held)
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

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    one_pair<2>(claims);
    one_pair<3>(claims);
    different_radii(claims);
    networks(claims);
  });
}

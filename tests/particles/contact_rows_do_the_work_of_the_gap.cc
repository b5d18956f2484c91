// The rate of a contact is the rate of change of its gap for any motion of the
// particles, and its force does the work F_r times that rate: on both
// particles, on a particle and its image, and on the meshed shares of them.

#include <cmath>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

template <int dim>
void
check(Tests::Claims &claims)
{
  auto scenes = Tests::pairs_at<dim>(Tests::held_distance - 1e-6);
  if constexpr (dim == 3)
    {
      scenes.push_back({"on the mirror plane",
                        Tests::scene_of<dim>(Symmetry::half,
                                             {{Point<dim>(1., 0.2, 0.)},
                                              {Point<dim>(-1., -0.1, 0.)}})});
      scenes.push_back({"one on and one off the mirror plane",
                        Tests::scene_of<dim>(Symmetry::half,
                                             {{Point<dim>(0.7, 0.2, 0.)},
                                              {Point<dim>(-0.3, -0.1, 1.7)}})});
    }

  for (const auto &named : scenes)
    {
      const Scene<dim>      &scene = named.scene;
      const RigidBodies<dim> bodies(scene);
      Contacts<dim>          contacts(scene, Tests::minimal_gap);
      auto                   centres = Tests::configuration_of(scene);
      contacts.enforce(centres);
      const Contact<dim> contact = contacts.held(centres).at(0);

      // any motion
      std::vector<double> values;
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        values.push_back(std::sin(1. + 3.7 * k));
      const auto motions = bodies.motions(values);

      const auto gap_after = [&](const double dt) {
        auto moved = centres;
        for (unsigned int i = 0; i < moved.centres.size(); ++i)
          moved.centres[i] += dt * motions[i].velocity;
        return 2. * contacts.smallest_gap(moved);
      };
      const double dt         = 1e-5;
      const double difference = (gap_after(dt) - gap_after(-dt)) / (2. * dt);

      const std::vector<double> rate  = contact.rate(bodies),
                                force = contact.force(bodies);
      double rate_of_gap = 0., power = 0.;
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        {
          rate_of_gap += rate[k] * values[k];
          power += force[k] / bodies.meshed_share(k) * values[k];
        }
      // its image does the same work
      if (contact.i == contact.j)
        power *= 2.;

      const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
      claims.near(named.name + ": rate of the gap" + suffix,
                  rate_of_gap,
                  difference,
                  1e-8);
      claims.near(named.name + ": work of the force" + suffix,
                  power,
                  rate_of_gap,
                  1e-13);
      claims.at_least(named.name + ": the motion changes the gap" + suffix,
                      std::abs(rate_of_gap),
                      0.01);
    }
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check<2>(claims);
    check<3>(claims);
  });
}

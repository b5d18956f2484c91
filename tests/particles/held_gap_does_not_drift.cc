// Particles that revolve about each other for many turns, with steps whose
// error of second order pulls them apart, stay at exactly the smallest gap as
// long as they are held.

#include <cmath>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

template <int dim>
void
revolve(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  for (const auto &pair : Tests::pairs_at<dim>(Tests::held_distance - 1e-3))
    {
      // positions in other images than at the start are another matter
      if (pair.name == "with the image of another")
        continue;
      Contacts<dim> contacts(pair.scene, Tests::minimal_gap);
      auto          centres = Tests::configuration_of(pair.scene);
      contacts.enforce(centres);
      contacts.remember(contacts.candidates(centres), {1.});
      const auto start = centres;

      // the centre of the turning
      const bool     free = !pair.scene.rotational();
      Tensor<1, dim> to_end;
      if (pair.name == "across the end of the period")
        to_end[0] = 80.;
      Point<dim> middle;
      if (free)
        middle =
          Point<dim>((centres.centres[0] + centres.centres[1] + to_end) / 2.);

      // an explicit step along the tangent: the distance grows by dt^2/2
      const double dt            = 0.05;
      double       largest_drift = 0., smallest_gain = 1.;
      bool         always_held = true;
      for (unsigned int step = 0; step < 2000; ++step)
        {
          for (unsigned int i = 0; i < centres.centres.size(); ++i)
            {
              Point<dim> p = centres.centres[i];
              if (free && i == 1)
                p += to_end;
              const Tensor<1, dim> arm = p - middle;
              centres.centres[i] +=
                dt * Tensor<1, dim>(Tests::point<dim>(-arm[1], arm[0]));
            }
          smallest_gain =
            std::min(smallest_gain,
                     contacts.smallest_gap(centres) - Tests::minimal_gap);
          contacts.enforce(centres);
          const auto touching = contacts.candidates(centres);
          contacts.remember(touching, std::vector<double>(touching.size(), 1.));
          largest_drift = std::max(largest_drift,
                                   std::abs(contacts.smallest_gap(centres) -
                                            Tests::minimal_gap));
          always_held   = always_held && contacts.n_held() == 1;
        }
      claims.at_least(pair.name + ": the steps do open the gap" + suffix,
                      smallest_gain,
                      1e-3);
      claims.at_most(pair.name + ": the gap does not drift" + suffix,
                     largest_drift,
                     1e-13);
      claims.holds(pair.name + ": it is held throughout" + suffix, always_held);
      if (free)
        claims.near(pair.name + ": nor does the pair" + suffix,
                    (centres.centres[0] + centres.centres[1])
                      .distance(start.centres[0] + start.centres[1]),
                    0.,
                    1e-11);
    }
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    revolve<2>(claims);
    revolve<3>(claims);
  });
}

// A held pair is let go when its force is attractive, is not held again at once
// by the rounding of the very distance it was held at, and can be held again
// later. Other pairs are not affected.

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

void
one_pair(Tests::Claims &claims)
{
  for (const auto &pair : Tests::pairs_at<3>(Tests::held_distance - 0.01))
    {
      Contacts<3> contacts(pair.scene, Tests::minimal_gap);
      auto        centres = Tests::configuration_of(pair.scene);
      contacts.enforce(centres);

      contacts.release({1.});
      claims.holds(pair.name + ": repulsion is kept", contacts.n_held() == 1);
      contacts.release({0.});
      claims.holds(pair.name + ": no force is kept", contacts.n_held() == 1);
      contacts.release({-1e-9});
      claims.holds(pair.name + ": attraction is let go",
                   contacts.n_held() == 0 && contacts.held(centres).empty());

      // The step that follows moves the pair a little, also inwards.
      const auto approach = [&]() {
        const unsigned int last = centres.centres.size() - 1;
        const auto         near = pair.scene.rotational() && last == 0 ?
                                    Point<3>() :
                                    centres.centres[0];
        Tensor<1, 3>       line = centres.centres[last] - near;
        if (pair.name == "across the end of the period")
          line[0] += 80.;
        if (pair.name == "with the image of another")
          line = centres.centres[last] + near;
        centres.centres[last] -= 1e-4 * line / line.norm();
      };
      approach();
      contacts.enforce(centres);
      claims.holds(pair.name + ": it is not held again in the next step",
                   contacts.n_held() == 0);
      claims.near(pair.name + ": but its gap does not fall below the minimum",
                  contacts.smallest_gap(centres),
                  Tests::minimal_gap,
                  1e-13);

      approach();
      contacts.enforce(centres);
      claims.holds(pair.name + ": it is held again in the step after",
                   contacts.n_held() == 1);
    }
}

/// Which of three contacts in a row are held after forces of these signs?
std::string
kept(const std::vector<double> &forces)
{
  std::vector<Particle<3>> row;
  for (unsigned int i = 0; i < 4; ++i)
    row.push_back({Point<3>(2.03 * i, 0., 0.)});
  const auto  scene = Tests::scene_of<3>(Symmetry::none, row);
  Contacts<3> contacts(scene, Tests::minimal_gap);
  auto        centres = Tests::configuration_of(scene);
  contacts.enforce(centres);
  contacts.release(forces);
  std::string result;
  for (const auto &contact : contacts.held(centres))
    result += std::to_string(contact.j) + std::to_string(contact.i) + " ";
  return result;
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    one_pair(claims);
    claims.holds("row: all repel", kept({1., 2., 3.}) == "01 12 23 ");
    claims.holds("row: the middle one attracts",
                 kept({1., -2., 3.}) == "01 23 ");
    claims.holds("row: the ends attract", kept({-1., 2., -3.}) == "12 ");
    claims.holds("row: all attract", kept({-1., -2., -3.}).empty());
  });
}

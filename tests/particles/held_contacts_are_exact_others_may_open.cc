// A contact that repels is brought back to the smallest gap after a step, also
// when the step has opened it; one without force, or with attraction, may open
// at once but not close. Particles that are replaced by their images meanwhile
// keep their contacts.

#include <cmath>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// The last particle, moved by @p distance away from its partner.
template <int dim>
Configuration<dim>
opened(const Contact<dim> &contact,
       Configuration<dim>  configuration,
       const double        distance)
{
  // i is the last one; towards its own image both move
  const bool with_image = contact.i == contact.j;
  configuration.centres[contact.i] +=
    (with_image ? 0.5 : 1.) * distance * contact.direction;
  return configuration;
}



template <int dim>
void
one_pair(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  for (const auto &pair : Tests::pairs_at<dim>(Tests::held_distance - 0.01))
    {
      Contacts<dim> contacts(pair.scene, Tests::minimal_gap);
      auto          touching = Tests::configuration_of(pair.scene);
      contacts.enforce(touching);
      const auto candidates = contacts.candidates(touching);
      claims.holds(pair.name + ": a contact, but not held" + suffix,
                   candidates.size() == 1 && contacts.n_held() == 0 &&
                     contacts.remembered_forces(candidates)[0] == 0.);

      const auto gap_after_step = [&](const double force, const double step) {
        contacts.remember(candidates, {force});
        auto after = opened<dim>(candidates[0], touching, step);
        contacts.enforce(after);
        return contacts.smallest_gap(after) - Tests::minimal_gap;
      };
      claims.near(pair.name + ": with repulsion it does not open" + suffix,
                  gap_after_step(2., 1e-3),
                  0.,
                  1e-13);
      claims.near(pair.name + ": nor does it close" + suffix,
                  gap_after_step(2., -1e-3),
                  0.,
                  1e-13);
      claims.holds(pair.name + ": the force is remembered" + suffix,
                   contacts.n_held() == 1 &&
                     contacts.remembered_forces(candidates)[0] == 2.);
      for (const double force : {0., -1.})
        {
          const std::string name =
            force == 0. ? "without force" : "with attraction";
          claims.near(pair.name + ": " + name + " it opens" + suffix,
                      gap_after_step(force, 1e-3),
                      0.5e-3,
                      1e-13);
          claims.near(pair.name + ": " + name + " it does not close" + suffix,
                      gap_after_step(force, -1e-3),
                      0.,
                      1e-13);
          claims.holds(pair.name + ": " + name + " it is not held" + suffix,
                       contacts.n_held() == 0);
        }

      // the last particle is replaced by each of its images
      contacts.remember(candidates, {1.});
      const auto after  = opened<dim>(candidates[0], touching, 1e-3);
      double     error  = 0.;
      for (const auto &image : pair.scene.images())
        if (std::abs(image(after.centres.back())[0]) < 45.)
          {
            auto replaced           = after;
            replaced.centres.back() = image(after.centres.back());
            contacts.enforce(replaced);
            error = std::max(error,
                             std::abs(contacts.smallest_gap(replaced) -
                                      Tests::minimal_gap));
          }
      claims.at_most(pair.name + ": it is held also as an image" + suffix,
                     error,
                     1e-13);
    }
}



/// Which of three contacts in a row stay closed in a step that opens all?
std::string
kept(const std::vector<double> &forces)
{
  std::vector<Particle<3>> row;
  for (unsigned int i = 0; i < 4; ++i)
    row.push_back({Point<3>(Tests::held_distance * i, 0., 0.)});
  const auto  scene = Tests::scene_of<3>(Symmetry::none, row);
  Contacts<3> contacts(scene, Tests::minimal_gap);
  auto        centres = Tests::configuration_of(scene);
  contacts.remember(contacts.candidates(centres), forces);
  for (unsigned int i = 0; i < 4; ++i)
    centres.centres[i][0] += 0.01 * i;
  contacts.enforce(centres);
  std::string result;
  for (const auto &contact : contacts.candidates(centres))
    result += std::to_string(contact.j) + std::to_string(contact.i) + " ";
  return result;
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    one_pair<2>(claims);
    one_pair<3>(claims);
    claims.holds("row: all repel", kept({1., 2., 3.}) == "01 12 23 ");
    claims.holds("row: the middle one attracts",
                 kept({1., -2., 3.}) == "01 23 ");
    claims.holds("row: the ends attract", kept({-1., 2., -3.}) == "12 ");
    claims.holds("row: all attract", kept({-1., -2., -3.}).empty());
  });
}

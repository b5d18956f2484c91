// The rate of a contact is the rate of change of its gap for any motion of the
// particles: of two, of one and its image, of one and a wall or a mirror plane.
// The forces on the meshed parts are the shares of those on whole particles,
// which are pressed by all contacts in the box without symmetries.

#include <cmath>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// Distances from planes at which the gap is the smallest one.
constexpr double wall_distance   = 1. + 2. * Tests::minimal_gap;
constexpr double mirror_distance = 1. + Tests::minimal_gap;



template <int dim>
std::vector<Tests::NamedScene<dim>>
scenes()
{
  auto result = Tests::pairs_at<dim>(Tests::held_distance - 1e-6);
  if constexpr (dim == 3)
    {
      result.push_back({"on the mirror plane",
                        Tests::scene_of<dim>(Symmetry::half,
                                             {{Point<dim>(1., 0.2, 0.)},
                                              {Point<dim>(-1., -0.1, 0.)}})});
      result.push_back({"one on and one off the mirror plane",
                        Tests::scene_of<dim>(Symmetry::half,
                                             {{Point<dim>(0.7, 0.2, 0.)},
                                              {Point<dim>(-0.3, -0.1, 1.7)}})});
      result.push_back(
        {"off the mirror plane, with the own image",
         Tests::scene_of<dim>(Symmetry::quarter, {{Point<dim>(1., 0.2, 3.)}})});
      result.push_back({"off the mirror plane, with one on the axis in it",
                        Tests::scene_of<dim>(Symmetry::quarter,
                                             {{Point<dim>(), 1., true},
                                              {Point<dim>(1., 0.4, 1.7)}})});
    }
  return result;
}



/// Rate of the gap of contact @p c for motions by @p values.
template <int dim>
double
rate_of_gap(const Contact<dim>        &contact,
            const RigidBodies<dim>    &bodies,
            const std::vector<double> &values)
{
  const std::vector<double> rate = contact.rate(bodies);
  double                    sum  = 0.;
  for (unsigned int k = 0; k < values.size(); ++k)
    sum += rate[k] * values[k];
  return sum;
}



/// Any motion.
template <int dim>
std::vector<double>
some_values(const RigidBodies<dim> &bodies)
{
  std::vector<double> values;
  for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
    values.push_back(std::sin(1. + 3.7 * k));
  return values;
}



template <int dim>
void
rates(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  for (const auto &named : scenes<dim>())
    {
      const RigidBodies<dim> bodies(named.scene);
      const Contacts<dim>    contacts(named.scene, Tests::minimal_gap);
      auto                   centres = Tests::configuration_of(named.scene);
      contacts.enforce(centres);

      const auto values    = some_values<dim>(bodies);
      const auto motions   = bodies.motions(values);
      const auto gap_after = [&](const double dt) {
        auto moved = centres;
        for (unsigned int i = 0; i < moved.centres.size(); ++i)
          moved.centres[i] += dt * motions[i].velocity;
        return 2. * contacts.smallest_gap(moved);
      };
      const double dt         = 1e-5;
      const double difference = (gap_after(dt) - gap_after(-dt)) / (2. * dt);

      const auto found = contacts.candidates(centres);
      claims.near(named.name + ": contacts" + suffix, found.size(), 1, 0);
      const double rate = rate_of_gap<dim>(found.at(0), bodies, values);
      claims.near(named.name + ": rate of the gap" + suffix,
                  rate,
                  difference,
                  1e-8);
      claims.at_least(named.name + ": the motion changes the gap" + suffix,
                      std::abs(rate),
                      0.01);
    }
}



/// Force on every whole particle if every contact repels by one.
template <int dim>
std::vector<double>
forces_on_particles(const Scene<dim> &scene)
{
  const RigidBodies<dim> bodies(scene);
  const Contacts<dim>    contacts(scene, Tests::minimal_gap);
  std::vector<double>    forces(bodies.n_unknowns(), 0.);
  for (const auto &contact :
       contacts.candidates(Tests::configuration_of(scene)))
    {
      const auto rate = contact.rate(bodies);
      for (unsigned int k = 0; k < forces.size(); ++k)
        forces[k] += contact.meshed_share * rate[k] / bodies.meshed_share(k);
    }
  return forces;
}



template <int dim>
void
forces(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  auto              all    = scenes<dim>();
  const double      half   = Tests::held_distance / 2.;
  all.push_back(
    {"with another and its image",
     Tests::scene_of<dim>(Symmetry::quarter,
                          {{Tests::point<dim>(half, 0.)},
                           {Tests::point<dim>(0., std::sqrt(3.) * half)}})});
  all.push_back(
    {"in the corner of a wall and a mirror plane",
     Tests::scene_of<dim>(
       Symmetry::quarter,
       {{Tests::point<dim>(3., 20. - wall_distance, 10. - mirror_distance)},
        {Tests::point<dim>(7., wall_distance - 20., 0.)}})});
  for (const auto &named : all)
    {
      const RigidBodies<dim> bodies(named.scene);
      const Scene<dim>       whole = Tests::whole_box(named.scene);
      const RigidBodies<dim> all_bodies(whole);
      const auto             reduced  = forces_on_particles(named.scene);
      const auto             expected = forces_on_particles(whole);
      double                 error = 0., largest = 0.;
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        {
          const auto &unknown = bodies.unknown(k);
          const auto  range   = all_bodies.range(unknown.particle);
          for (unsigned int l = range.first; l < range.second; ++l)
            if (all_bodies.unknown(l).rotation == unknown.rotation &&
                all_bodies.unknown(l).axis == unknown.axis)
              error = std::max(error, std::abs(reduced[k] - expected[l]));
          largest = std::max(largest, std::abs(reduced[k]));
        }
      claims.at_most(named.name + ": forces as in the whole box" + suffix,
                     error,
                     1e-12);
      claims.at_least(named.name + ": there are forces" + suffix, largest, 0.1);
    }
}



/// Contacts with walls and mirror planes of a sphere in a corner.
void
planes(Tests::Claims &claims)
{
  for (const double side : {-1., 1.})
    {
      const auto scene =
        Tests::scene_of<3>(Symmetry::none,
                           {{Point<3>(3.,
                                      side * (20. - wall_distance),
                                      side * (10. - mirror_distance))}});
      const RigidBodies<3> bodies(scene);
      const Contacts<3>    contacts(scene, Tests::minimal_gap);
      const auto           values = some_values<3>(bodies);
      const auto found = contacts.candidates(Tests::configuration_of(scene));
      const std::string name = side < 0. ? "low side" : "high side";
      claims.near(name + ": contacts", found.size(), 2., 0.);
      claims.near(name + ": a wall gets closer like the particle",
                  rate_of_gap<3>(found.at(0), bodies, values),
                  -side * values[1],
                  1e-14);
      claims.near(name + ": a mirror image twice as fast",
                  rate_of_gap<3>(found.at(1), bodies, values),
                  -2. * side * values[2],
                  1e-14);
      const auto forces = forces_on_particles<3>(scene);
      claims.near(name + ": force of a wall", forces[1], -side, 1e-14);
      claims.near(name + ": force of a mirror image", forces[2], -side, 1e-14);
    }
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    rates<2>(claims);
    rates<3>(claims);
    forces<2>(claims);
    forces<3>(claims);
    planes(claims);
  });
}

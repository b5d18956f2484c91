// Three discs or spheres in a sheared fluid are pressed together by forces
// along their line, which turns meanwhile, and then pulled apart; and one is
// pressed against a wall and pulled off it. The gaps close, are held at exactly
// the smallest one as long as there is pressure, and open at once afterwards.

#include <catena/base/time_history.h>
#include <catena/particles/contacts.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

constexpr double dt           = 0.05;
constexpr double press_strain = 0.8, final_strain = 1.6;

/// Force on particle @p i at an instant.
template <int dim>
using Forces = std::function<Tensor<1, dim>(const unsigned int,
                                            const std::vector<Point<dim>> &)>;

/// All gaps that may close, in radii.
template <int dim>
using Gaps =
  std::function<std::vector<double>(const std::vector<Point<dim>> &)>;



/// What has been seen of the gaps.
struct History
{
  unsigned int n_held = 0, n_held_at_end = 0;
  double       narrowest = std::numeric_limits<double>::max();
  double       drift = 0., smallest_force = 0., largest_force = 0.;
  double       smallest_gap_at_end = 0.;
};



/**
 * Move the particles by the formula of Adams and Bashforth, with a new mesh in
 * every step. The forces press first and pull after.
 */
template <int dim>
History
simulate(Scene<dim>         scene,
         const double       minimal_gap,
         const Forces<dim> &pressing,
         const Gaps<dim>   &gaps)
{
  const double                  smallest = 2. * minimal_gap;
  Contacts<dim>                 contacts(scene, minimal_gap);
  std::vector<RigidMotion<dim>> now, before;
  History                       history;
  const unsigned int            n_steps = std::lround(final_strain / dt);
  for (unsigned int step = 0; step <= n_steps; ++step)
    {
      const TimeStep        times{dt, step > 1 ? dt : 0.};
      const TwoLevelWeights weights = times.adams_bashforth();
      Configuration<dim>    configuration;
      for (unsigned int i = 0; i < scene.particles.size(); ++i)
        {
          Point<dim> &centre = scene.particles[i].centre;
          if (step > 0)
            centre += dt * weights.b0 * now[i].velocity;
          if (step > 1)
            centre += dt * weights.b1 * before[i].velocity;
          configuration.centres.push_back(centre);
        }
      contacts.enforce(configuration);
      for (unsigned int i = 0; i < scene.particles.size(); ++i)
        scene.particles[i].centre = configuration.centres[i];
      const auto widths    = gaps(configuration.centres);
      const auto narrowest = *std::min_element(widths.begin(), widths.end());
      history.narrowest    = std::min(history.narrowest, narrowest - smallest);
      if (contacts.n_held() > 0)
        history.drift = std::max(history.drift, std::abs(narrowest - smallest));

      MeshParameters resolution = Tests::resolution(16, 1);
      if (dim == 3)
        resolution.growth = 0.5;
      Tests::StokesProblem<dim> problem(scene, resolution, 1e-8);
      if (step > 0)
        problem.fields.motions = now;
      const auto candidates         = contacts.candidates(configuration);
      problem.fields.contact_forces = contacts.remembered_forces(candidates);
      const double        sign = step * dt < press_strain - 1e-9 ? 1. : -1.;
      std::vector<double> forces(problem.bodies.n_unknowns(), 0.);
      for (unsigned int k = 0; k < forces.size(); ++k)
        {
          const auto &unknown = problem.bodies.unknown(k);
          if (!unknown.rotation)
            forces[k] = sign * pressing(unknown.particle,
                                        configuration.centres)[unknown.axis];
        }
      problem.solve(forces, candidates);
      contacts.remember(candidates, problem.fields.contact_forces);
      before = now;
      now    = problem.fields.motions;

      history.n_held        = std::max(history.n_held, contacts.n_held());
      history.n_held_at_end = contacts.n_held();
      for (const double force : problem.fields.contact_forces)
        {
          history.smallest_force = std::min(history.smallest_force, force);
          history.largest_force  = std::max(history.largest_force, force);
        }
      history.smallest_gap_at_end = narrowest - smallest;
      Tests::print("strain ",
                   step * dt,
                   ", narrowest gap ",
                   narrowest,
                   ", contacts ",
                   candidates.size(),
                   ", held ",
                   contacts.n_held());
    }
  return history;
}



void
check(Tests::Claims     &claims,
      const std::string &name,
      const unsigned int n_contacts,
      const History     &history)
{
  claims.near(name + ": all contacts are held", history.n_held, n_contacts, 0.);
  claims.at_least(name + ": with strong forces", history.largest_force, 1.);
  claims.at_least(name + ": that never attract", history.smallest_force, 0.);
  claims.at_least(name + ": no gap is below the smallest",
                  history.narrowest,
                  -1e-12);
  claims.at_most(name + ": a held gap does not drift", history.drift, 1e-12);
  claims.holds(name + ": all are let go", history.n_held_at_end == 0);
  claims.at_least(name + ": and have opened",
                  history.smallest_gap_at_end,
                  0.05);
}



template <int dim>
void
three_in_a_line(Tests::Claims &claims)
{
  Scene<dim> scene;
  scene.length    = 14.;
  scene.height    = 9.;
  scene.width     = 6.;
  scene.symmetry  = dim == 3 ? Symmetry::half : Symmetry::none;
  scene.particles = {{Tests::polar<dim>(2.4, 200.)},
                     {Tests::polar<dim>(0.1, 0.)},
                     {Tests::polar<dim>(2.3, 20.)}};

  const auto pressing = [](const unsigned int             i,
                           const std::vector<Point<dim>> &x) {
    const Tensor<1, dim> line = (x[2] - x[0]) / x[2].distance(x[0]);
    // more than the force by which the shear presses them together
    const double force = dim == 2 ? 30. : 90.;
    return (i == 0 ? force : (i == 2 ? -force : 0.)) * line;
  };
  const auto gaps = [](const std::vector<Point<dim>> &x) {
    return std::vector<double>{x[0].distance(x[1]) - 2.,
                               x[1].distance(x[2]) - 2.,
                               x[0].distance(x[2]) - 2.};
  };
  check(claims,
        dim == 2 ? "three discs" : "three spheres",
        2,
        simulate<dim>(scene, 0.05, pressing, gaps));
}



template <int dim>
void
at_wall(Tests::Claims &claims)
{
  Scene<dim> scene;
  scene.length    = 10.;
  scene.height    = 6.;
  scene.width     = 6.;
  scene.symmetry  = dim == 3 ? Symmetry::half : Symmetry::none;
  scene.particles = {{Tests::polar<dim>(1.75, 80.)}};

  const auto pressing = [](const unsigned int,
                           const std::vector<Point<dim>> &) {
    Tensor<1, dim> force;
    force[1] = 30.;
    return force;
  };
  const auto gaps = [](const std::vector<Point<dim>> &x) {
    return std::vector<double>{3. - x[0][1] - 1.};
  };
  check(claims,
        dim == 2 ? "disc at a wall" : "sphere at a wall",
        1,
        simulate<dim>(scene, 0.1, pressing, gaps));
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    three_in_a_line<2>(claims);
    three_in_a_line<3>(claims);
    at_wall<2>(claims);
    at_wall<3>(claims);
  });
}

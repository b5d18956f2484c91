// The unknown motions of a particle are those its place in the scene allows, in
// the order of the particles, translations first.

#include <algorithm>
#include <cmath>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// The unknowns in words: "0:Ux 0:Uy 0:wz "
template <int dim>
std::string
unknowns(const Symmetry symmetry, const std::vector<Particle<dim>> &particles)
{
  const RigidBodies<dim> bodies(Tests::scene_of<dim>(symmetry, particles));
  std::string            result;
  for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
    {
      const auto &unknown = bodies.unknown(k);
      result += std::to_string(unknown.particle) +
                (unknown.rotation ? ":w" : ":U") + "xyz"[unknown.axis] + ' ';
      // ranges hold exactly the unknowns of a particle
      const auto range = bodies.range(unknown.particle);
      if (k < range.first || k >= range.second)
        result += "out of range ";
    }
  return result;
}

void
numbering(Tests::Claims &claims)
{
  const Particle<3> at{Point<3>(3., 1., 0.)}, off{Point<3>(-3., -1., 2.)},
    axis{Point<3>(), 1., true};
  const std::string all_0 = "0:Ux 0:Uy 0:Uz 0:wx 0:wy 0:wz ",
                    all_1 = "1:Ux 1:Uy 1:Uz 1:wx 1:wy 1:wz ";

  claims.holds("no particle, no unknown",
               unknowns<3>(Symmetry::none, {}).empty());
  claims.holds("3D, whole box: six unknowns a particle",
               unknowns<3>(Symmetry::none, {at, off}) == all_0 + all_1);
  claims.holds("3D, half: three in the mirror plane, six off it",
               unknowns<3>(Symmetry::half, {at, off}) ==
                 "0:Ux 0:Uy 0:wz " + all_1);
  claims.holds("3D, quarter: on the axis, in the plane and off it",
               unknowns<3>(Symmetry::quarter,
                           {axis, {Point<3>(3., 1., 0.)}, off}) ==
                 "0:wz 1:Ux 1:Uy 1:wz "
                 "2:Ux 2:Uy 2:Uz 2:wx 2:wy 2:wz ");

  const Particle<2> disc{Point<2>(3., 1.)}, disc_on_axis{Point<2>(), 1., true};
  claims.holds("2D, whole box: three unknowns a disc",
               unknowns<2>(Symmetry::none, {disc}) == "0:Ux 0:Uy 0:wz ");
  claims.holds("2D, quarter: one on the axis",
               unknowns<2>(Symmetry::quarter, {disc_on_axis, disc}) ==
                 "0:wz 1:Ux 1:Uy 1:wz ");
}



/**
 * A unit of each unknown moves the surface as U + omega x arm, and motions()
 * and values() are inverse to each other.
 */
template <int dim>
void
motions(Tests::Claims &claims, const Scene<dim> &scene, const std::string &name)
{
  const RigidBodies<dim> bodies(scene);
  std::vector<double>    values;
  for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
    values.push_back(std::cos(1. + 2.3 * k));
  const auto motions = bodies.motions(values);
  claims.holds(name + ": motions and values are inverse",
               bodies.values(motions) == values &&
                 motions.size() == scene.particles.size());

  const Tensor<1, dim> arm   = Tests::point<dim>(0.3, -0.5, 0.8);
  double               error = 0.;
  for (unsigned int i = 0; i < motions.size(); ++i)
    {
      const auto          &U = motions[i].velocity;
      const auto          &w = motions[i].angular_velocity;
      const double         z = dim == 3 ? arm[dim - 1] : 0.;
      const Tensor<1, dim> expected =
        U + Tests::point<dim>(w[1] * z - w[2] * arm[1],
                              w[2] * arm[0] - w[0] * z,
                              w[0] * arm[1] - w[1] * arm[0]);
      Tensor<1, dim> sum;
      const auto     range = bodies.range(i);
      for (unsigned int k = range.first; k < range.second; ++k)
        sum += values[k] * bodies.unit_velocity(k, arm);
      error = std::max({error,
                        (sum - expected).norm(),
                        (motions[i].at(arm) - expected).norm()});
    }
  claims.at_most(name + ": unit motions add up to U + omega x arm",
                 error,
                 1e-15);
}



void
shares(Tests::Claims &claims)
{
  const auto share = [](const Symmetry symmetry, const Particle<3> &particle) {
    const RigidBodies<3> bodies(Tests::scene_of<3>(symmetry, {particle}));
    return bodies.meshed_share(bodies.n_unknowns() - 1);
  };
  const Particle<3> at{Point<3>(3., 1., 0.)}, off{Point<3>(3., 1., 2.)},
    axis{Point<3>(), 1., true};
  claims.near("whole box: whole", share(Symmetry::none, at), 1., 0.);
  claims.near("half: half on the mirror", share(Symmetry::half, at), 0.5, 0.);
  claims.near("half: whole off it", share(Symmetry::half, off), 1., 0.);
  claims.near("quarter: half on the mirror",
              share(Symmetry::quarter, at),
              0.5,
              0.);
  claims.near("quarter: whole off it", share(Symmetry::quarter, off), 1., 0.);
  claims.near("quarter: a quarter on the axis",
              share(Symmetry::quarter, axis),
              0.25,
              0.);

  const RigidBodies<2> discs(
    Tests::scene_of<2>(Symmetry::quarter,
                       {{Point<2>(), 1., true}, {Point<2>(3., 1.)}}));
  claims.near("2D: half on the axis", discs.meshed_share(0), 0.5, 0.);
  claims.near("2D: whole beside it", discs.meshed_share(1), 1., 0.);
}



void
held_in_place(Tests::Claims &claims)
{
  RigidBodies<3> bodies(
    Tests::scene_of<3>(Symmetry::none, {{Point<3>(3., 1., 0.)}}));
  const auto free = [&]() {
    std::string result;
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      result += bodies.is_free(k) ? '1' : '0';
    return result;
  };
  claims.holds("all motions are free at the start", free() == "111111");
  bodies.hold_in_place(true);
  claims.holds("held in place, a particle only turns", free() == "000111");
  bodies.hold_in_place(false);
  claims.holds("then all are free again", free() == "111111");
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    numbering(claims);
    for (const auto &named : Tests::pairs_at<2>(3.))
      motions<2>(claims, named.scene, named.name + ", 2D");
    for (const auto &named : Tests::pairs_at<3>(3.))
      motions<3>(claims, named.scene, named.name + ", 3D");
    shares(claims);
    held_in_place(claims);
  });
}

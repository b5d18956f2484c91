// A disc is pressed against a fixed one in a shear flow. The fixed disc neither
// moves nor turns, also not by the contact, which carries the load and leaves
// the free disc at the smallest gap. What overlaps is put right by moving the
// free disc alone.

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    Scene<2> scene;
    scene.length = 12.;
    scene.height = 10.;
    scene.particles.resize(2);
    scene.particles[0].centre = Point<2>(-0.5, 0.4);
    scene.particles[0].fixed  = true;
    scene.particles[1].centre = scene.particles[0].centre + Point<2>(2.03, 0.);

    Contacts<2>      contacts(scene, 0.02);
    Configuration<2> configuration;
    for (const auto &particle : scene.particles)
      configuration.centres.push_back(particle.centre);
    contacts.enforce(configuration);
    claims.near("the fixed disc keeps its place",
                configuration.centres[0].distance(scene.particles[0].centre),
                0.,
                0.);
    claims.near("the free disc is put at the smallest gap",
                configuration.centres[0].distance(configuration.centres[1]),
                2.04,
                1e-10);
    scene.particles[1].centre = configuration.centres[1];

    Tests::StokesProblem<2> problem(scene, Tests::resolution(32, 2));
    const auto candidates = contacts.candidates(problem.configuration);
    claims.near("there is one contact", candidates.size(), 1., 0.);
    const unsigned int  pushed = problem.bodies.range(1).first;
    std::vector<double> forces(problem.bodies.n_unknowns(), 0.);
    forces[pushed] = -100.;
    problem.solve(forces, candidates);

    const auto  &motions = problem.fields.motions;
    const double force   = problem.fields.contact_forces.at(0);
    Tests::print("contact force ", force);
    claims.at_most("the fixed disc neither moves nor turns",
                   motions[0].velocity.norm() +
                     motions[0].angular_velocity.norm(),
                   0.);
    claims.near("the free disc keeps its distance",
                motions[1].velocity[0],
                0.,
                1e-8);
    claims.at_least("and turns", motions[1].angular_velocity[2], 1e-2);
    claims.near("the contact carries the load that the fluid does not",
                problem.forces()[pushed],
                forces[pushed] + force,
                1e-6);
  });
}

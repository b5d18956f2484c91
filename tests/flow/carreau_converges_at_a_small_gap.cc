// Three spheres whose smallest gap of 0.02 diameters is held, in fluids that
// thin as strongly as n = 0.1 and lambda_c = 100: the nonlinear solver
// converges from the imposed flow, the gap does not change, and without
// thinning a larger force is needed to hold it.

#include <catena/particles/contacts.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "carreau_problem.h"

using namespace Catena;

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const Scene<3>           scene = Tests::three_particles<3>();
    Tests::CarreauProblem<3> problem(scene, Tests::resolution(32, 1), 1e-8);

    Contacts<3> contacts(scene, 0.02 + 1e-12);
    contacts.enforce(problem.configuration);
    const auto held = contacts.candidates(problem.configuration);
    claims.holds("the gap is held", held.size() == 1);

    const auto   guess           = problem.fields;
    const double newtonian_spin  = 0.5;
    double       force_at_larger = 1e10;
    for (const auto &fluid : std::vector<std::array<double, 2>>{
           {{1., 1.}}, {{0.7, 1.}}, {{0.3, 10.}}, {{0.1, 100.}}})
      {
        std::ostringstream name;
        name << "n = " << fluid[0] << ", lambda_c = " << fluid[1];
        problem.fields = guess;
        const auto report =
          problem.solve(Tests::carreau(fluid[0], fluid[1]), held);
        const auto  &motion = problem.fields.motions[1];
        const auto  &arm    = problem.configuration.centres[1];
        const double force  = problem.fields.contact_forces.at(0);
        Tests::print(name.str(),
                     ": force ",
                     force,
                     ", velocity ",
                     motion.velocity,
                     ", spins ",
                     problem.fields.motions[0].angular_velocity[2],
                     ' ',
                     motion.angular_velocity[2]);
        claims.at_most(name.str() + ": few steps",
                       report.picard_steps + report.newton_steps,
                       15);
        claims.at_most(name.str() + ": the gap stays",
                       std::abs(motion.velocity * arm),
                       1e-6);
        claims.holds(name.str() + ": repulsion, less than with less thinning",
                     force > 0. && force < force_at_larger);
        claims.holds(name.str() + ": the spheres turn slower than a lone one",
                     motion.angular_velocity[2] > 0. &&
                       motion.angular_velocity[2] < newtonian_spin);
        force_at_larger = force;
      }
  });
}

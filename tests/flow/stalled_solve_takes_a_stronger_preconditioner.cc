// A solve that does not converge in the iterations it has, with a
// preconditioner that is fresh, is repeated with a stronger one: in fewer
// iterations, with the same result. The next instant begins with the usual one.
// Where not even the stronger one is enough, an error says so.

#include "../tests.h"

#include "../mesh/scenes.h"
#include "stokes_problem.h"

using namespace Catena;



template <int dim>
void
test(Tests::Claims &claims, const Scene<dim> &scene, const std::string &name)
{
  const auto description = generate_mesh(scene, Tests::resolution(16, 1));
  Tests::StokesProblem<dim> usual(scene, description, 1e-9);
  const unsigned int        n = usual.solve();
  claims.near(name + ": usually nothing is repeated",
              usual.solver.repeated_solves().with_stronger_preconditioner,
              0.,
              0.);

  const unsigned int        too_few = 3 * n / 4;
  Tests::StokesProblem<dim> stalled(scene, description, 1e-9, too_few);
  claims.at_most(name + ": fewer iterations", stalled.solve(), too_few);
  const auto &repeated = stalled.solver.repeated_solves();
  claims.near(name + ": with a stronger preconditioner",
              repeated.with_stronger_preconditioner,
              1.,
              0.);
  claims.near(name + ": the fresh one would be no other",
              repeated.with_fresh_preconditioner,
              0.,
              0.);
  claims.near(name + ": same spin",
              stalled.fields.motions[0].angular_velocity[2],
              usual.fields.motions[0].angular_velocity[2],
              1e-7);

  stalled.solve();
  claims.holds(name + ": the next instant has one of its own",
               stalled.solver.has_fresh_preconditioner());
  claims.near(name + ": and nothing is repeated",
              repeated.with_stronger_preconditioner,
              1.,
              0.);

  Tests::StokesProblem<dim> hopeless(scene, description, 1e-9, 3);
  std::string               message;
  try
    {
      hopeless.solve();
    }
  catch (const SolverError &error)
    {
      message = error.what();
    }
  claims.holds(name + ": an error says what to do",
               message.find("raise 'Flow solver/Maximal iterations'") !=
                 std::string::npos);
  claims.near(name + ": after the stronger one",
              hopeless.solver.repeated_solves().with_stronger_preconditioner,
              1.,
              0.);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    test<2>(claims, Tests::three_particles<2>(2.1), "2D");
    test<3>(claims, Tests::three_particles<3>(2.1), "3D");
  });
}

// A Carreau fluid with n = 1 is Newtonian: the same fields and motions to the
// tolerance of the solvers.

#include "../tests.h"

#include "../mesh/scenes.h"
#include "carreau_problem.h"

using namespace Catena;

template <int dim>
void
check(Tests::Claims &claims, const MeshParameters &mesh)
{
  Tests::CarreauProblem<dim> newtonian(Tests::three_particles<dim>(2.3),
                                       mesh,
                                       1e-11),
    carreau(Tests::three_particles<dim>(2.3), mesh, 1e-11);
  newtonian.solve();
  carreau.solve(Tests::carreau(1., 10.));

  const std::string title      = "dim " + std::to_string(dim) + ": ";
  const auto        difference = [&](const VectorType &a, VectorType b) {
    b -= a;
    return b.linfty_norm();
  };
  claims.at_most(title + "same velocities",
                 difference(newtonian.fields.velocity, carreau.fields.velocity),
                 1e-8);
  claims.at_most(title + "same pressures",
                 difference(newtonian.fields.pressure, carreau.fields.pressure),
                 1e-7);
  for (unsigned int i = 0; i < 2; ++i)
    {
      const auto &a = newtonian.fields.motions[i],
                 &b = carreau.fields.motions[i];
      claims.at_most(title + "same motion of particle " + std::to_string(i),
                     (a.velocity - b.velocity).norm() +
                       (a.angular_velocity - b.angular_velocity).norm(),
                     1e-8);
    }
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check<2>(claims, Tests::resolution(32, 2));
    check<3>(claims, Tests::resolution(24, 1));
  });
}

// Without particles the shear of a Carreau fluid is linear, whatever the power
// index and whatever flow the iterations start from.

#include "../tests.h"

#include "carreau_problem.h"

using namespace dealii;
using namespace Catena;

template <int dim>
void
check(Tests::Claims &claims, const double power_index)
{
  Scene<dim> scene;
  scene.length = scene.height = scene.width = 2.;
  MeshParameters parameters;
  parameters.maximal_size = dim == 2 ? 0.2 : 0.6;
  Tests::CarreauProblem<dim> problem(scene, parameters);
  for (const auto node : problem.mesh.owned_nodes())
    {
      const auto   x = problem.position(node);
      const double disturbance =
        0.5 * std::sin(numbers::PI * x[0]) * std::cos(numbers::PI * x[1] / 2.);
      for (unsigned int d = 0; d < dim; ++d)
        problem.fields.velocity(dim * node + d) += disturbance;
    }
  problem.fields.velocity.update_ghost_values();
  problem.solve(Tests::carreau(power_index, 10.));

  double error = 0.;
  for (const auto node : problem.mesh.owned_nodes())
    {
      const auto u = Scene<dim>::imposed_velocity(problem.position(node));
      for (unsigned int d = 0; d < dim; ++d)
        error =
          std::max(error,
                   std::abs(problem.fields.velocity(dim * node + d) - u[d]));
    }
  std::ostringstream name;
  name << "dim " << dim << ", n = " << power_index;
  claims.at_most(name.str() + ": the velocity is linear", error, 1e-8);
  claims.at_most(name.str() + ": there is no pressure",
                 problem.fields.pressure.linfty_norm(),
                 1e-8);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const double power_index : {0.1, 0.3, 0.7, 1., 1.5})
      check<2>(claims, power_index);
    check<3>(claims, 0.3);
  });
}

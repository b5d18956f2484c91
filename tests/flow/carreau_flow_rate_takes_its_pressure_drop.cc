// The flow rate of a Carreau fluid between two walls is given: the pressure
// drop is that of tests/reference, for every power index and time, with an
// error that falls with the mesh as the fourth power of its size.

#include "../tests.h"

#include "../print.h"
#include "carreau_problem.h"

using namespace dealii;
using namespace Catena;

/// The fall of the pressure per length and the mean size of the cells.
std::pair<double, double>
pressure_gradient(const Carreau &model, const double size)
{
  Scene<2> scene;
  scene.length = 0.5;
  scene.height = 2.;
  scene.drive  = Drive::pressure;
  MeshParameters parameters;
  parameters.maximal_size = size;
  Tests::CarreauProblem<2> problem(scene, parameters, 1e-9);
  problem.configuration.shear_rate = 0.;
  problem.fields.velocity          = 0.;
  problem.solve(model);
  return {problem.fields.pressure_drop / scene.length,
          std::sqrt(scene.length * scene.height /
                    problem.mesh.n_global_cells())};
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const auto  table     = Tests::read_table("carreau_poiseuille.csv");
    const auto &times     = table["lambda_c*Umean/H(half height)"];
    const auto &gradients = table["-dp/dx*H^2/(eta0*Umean)"];
    for (unsigned int row = 0; row < table.n_rows; ++row)
      {
        const std::string name =
          "n = " + table.text.at("n")[row] + ", lambda_c = " +
          std::to_string(static_cast<int>(std::lround(10. * times[row]))) +
          "/10";
        const Carreau model       = Tests::carreau(table["n"][row], times[row]);
        const auto    coarse      = pressure_gradient(model, 0.1),
                   fine           = pressure_gradient(model, 0.05);
        const double coarse_error = coarse.first / gradients[row] - 1.;
        const double fine_error   = fine.first / gradients[row] - 1.;
        Tests::print(name, ": errors ", coarse_error, ", ", fine_error);
        claims.at_most(name + ": the pressure drop",
                       std::abs(fine_error),
                       1e-6);
        claims.at_least(name + ": its order",
                        std::log(std::abs(coarse_error / fine_error)) /
                          std::log(coarse.second / fine.second),
                        3.);
      }
  });
}

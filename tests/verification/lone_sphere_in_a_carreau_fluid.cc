// A free sphere turns at half the shear rate in unbounded fluid of any
// viscosity that depends on the rate alone. Of the box an error is left that
// falls as the box grows, and of the mesh one that falls as it is refined.

#include "../tests.h"

#include "../flow/carreau_problem.h"
#include "../mesh/scenes.h"

using namespace dealii;
using namespace Catena;

/// Spin of the sphere in a box of this size, on the quarter.
double
spin(const double size, const unsigned int elements)
{
  Scene<3> scene;
  scene.length = scene.height = scene.width = size;
  scene.symmetry                            = Symmetry::quarter;
  scene.particles                           = {{Point<3>(), 1., true}};
  MeshParameters mesh                       = Tests::resolution(elements, 2);
  mesh.maximal_size *= std::max(1., size / 40.);
  Tests::CarreauProblem<3> problem(scene, mesh, 1e-7);
  problem.solve(Tests::carreau(0.3, 10.));
  const double result = problem.fields.motions[0].angular_velocity[2];
  Tests::print("box ", size, ", ", elements, " on the equator: spin ", result);
  return result;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const double small = spin(10., 64), middle = spin(20., 64),
                 large = spin(40., 64), largest = spin(80., 64),
                 coarse = spin(80., 32);
    claims.near("half the shear rate in a box of 80 a", largest, 0.5, 5e-4);
    claims.at_most("the effect of the box falls",
                   (0.5 - middle) / (0.5 - small),
                   0.25);
    claims.at_most("and falls", (0.5 - large) / (0.5 - middle), 0.25);
    claims.at_most("that of the mesh falls",
                   (0.5 - largest) / (0.5 - coarse),
                   0.5);
  });
}

// Creeping flow of a generalised Newtonian fluid is reversible: if the walls
// turn back, all velocities and spins change their sign, and so does the
// pressure. Two discs and a sphere in places without symmetry.

#include "../tests.h"

#include "../mesh/scenes.h"
#include "carreau_problem.h"

using namespace Catena;

template <int dim>
void
check(Tests::Claims        &claims,
      const std::string    &title,
      const Scene<dim>     &scene,
      const MeshParameters &mesh)
{
  const Carreau              model = Tests::carreau(0.3, 10.);
  Tests::CarreauProblem<dim> forth(scene, mesh, 1e-10),
    back(scene, mesh, 1e-10);
  forth.solve(model);
  // from rest, not from the solution forth with another sign
  back.configuration.shear_rate = -1.;
  back.fields.velocity          = 0.;
  back.solve(model);

  const auto sum = [](const VectorType &a, VectorType b) {
    b += a;
    return b.linfty_norm();
  };
  claims.at_most(title + "velocities",
                 sum(forth.fields.velocity, back.fields.velocity),
                 1e-7);
  claims.at_most(title + "pressures",
                 sum(forth.fields.pressure, back.fields.pressure),
                 1e-6);
  for (unsigned int i = 0; i < scene.particles.size(); ++i)
    {
      const auto &a = forth.fields.motions[i], &b = back.fields.motions[i];
      claims.at_most(title + "motion of particle " + std::to_string(i),
                     (a.velocity + b.velocity).norm() +
                       (a.angular_velocity + b.angular_velocity).norm(),
                     1e-7);
      claims.at_least(title + "spin of particle " + std::to_string(i),
                      a.angular_velocity[2],
                      0.1);
    }
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    Scene<2> discs;
    discs.length    = 12.;
    discs.height    = 8.;
    discs.particles = {{dealii::Point<2>(-1., 0.4)},
                       {dealii::Point<2>(1.3, -1.1)}};
    check<2>(claims, "two discs: ", discs, Tests::resolution(32, 2));

    Scene<3> sphere;
    sphere.length = sphere.height = sphere.width = 8.;
    sphere.symmetry                              = Symmetry::half;
    sphere.particles = {{dealii::Point<3>(0.3, 1.2, 0.)}};
    check<3>(claims, "a sphere: ", sphere, Tests::resolution(24, 1));
  });
}

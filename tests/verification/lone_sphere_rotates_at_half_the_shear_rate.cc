// A free sphere in the middle of a sheared Newtonian fluid, u_x = -gamma y,
// stays where it is and turns at +gamma/2, a little slower in a small box. The
// box acts through the vorticity of the stresslets of the sphere's images,
// which falls with the cube of their distance: an eighth is left of its effect
// in a box of twice the size. A torque of 8 pi turns the sphere by one more.
// The whole sphere, half of it, and the quarters that both cuts leave.

#include "../tests.h"

#include "../flow/stokes_problem.h"
#include "../mesh/scenes.h"
#include "../print.h"

using namespace dealii;
using namespace Catena;

struct Domain
{
  std::string name;
  Symmetry    symmetry;
  Cut         cut;
};



double
largest(const std::vector<double> &values)
{
  double result = 0.;
  for (const double value : values)
    result = std::max(result, std::abs(value));
  return result;
}



std::unique_ptr<Tests::StokesProblem<3>>
solve(const Domain &domain, const std::string &box, const Point<3> &sizes)
{
  Scene<3> scene;
  scene.length    = sizes[0];
  scene.height    = sizes[1];
  scene.width     = sizes[2];
  scene.symmetry  = domain.symmetry;
  scene.cut       = domain.cut;
  scene.particles = {{Point<3>(), 1., domain.symmetry == Symmetry::quarter}};

  auto problem =
    std::make_unique<Tests::StokesProblem<3>>(scene,
                                              Tests::resolution(64, 2),
                                              1e-9);
  const unsigned int n_iterations = problem->solve();
  Tests::print(domain.name,
               ", ",
               box,
               ": ",
               problem->mesh.n_global_cells(),
               " cells, ",
               n_iterations,
               " iterations, velocity ",
               problem->fields.motions[0].velocity,
               ", angular velocity ",
               problem->fields.motions[0].angular_velocity);
  return problem;
}



/// Angular velocity of the free sphere in a box, after a look at all else.
double
spin(Tests::Claims                 &claims,
     const std::string             &title,
     const Tests::StokesProblem<3> &problem)
{
  claims.at_most(title + "no force or torque is on the sphere",
                 largest(problem.forces()),
                 1e-8);

  const auto &motion = problem.fields.motions[0];
  double      other  = motion.velocity.norm();
  for (unsigned int d = 0; d < 2; ++d)
    other = std::max(other, std::abs(motion.angular_velocity[d]));
  if (problem.bodies.n_unknowns() > 1)
    claims.at_most(title + "the sphere turns about z on the spot", other, 2e-5);
  return motion.angular_velocity[2];
}



/// The answer of the sphere to a torque about z.
void
check_torque(Tests::Claims           &claims,
             const std::string       &title,
             Tests::StokesProblem<3> &problem)
{
  const double        free_spin = problem.fields.motions[0].angular_velocity[2];
  std::vector<double> torque(problem.bodies.n_unknowns(), 0.);
  torque.back() = 8. * numbers::PI;
  problem.solve(torque);

  claims.near(title + "a torque of 8 pi turns it by one more",
              problem.fields.motions[0].angular_velocity[2] - free_spin,
              1.,
              1e-3);
  std::vector<double> forces = problem.forces();
  forces.back() -= torque.back();
  claims.at_most(title + "that torque is found in the fluid",
                 largest(forces),
                 1e-6);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const auto &domain :
         {Domain{"whole", Symmetry::none, Cut::x_plane},
          Domain{"half", Symmetry::half, Cut::x_plane},
          Domain{"quarter cut at x = 0", Symmetry::quarter, Cut::x_plane},
          Domain{"quarter cut at y = 0", Symmetry::quarter, Cut::y_plane}})
      {
        const auto cube = [&](const double size) {
          const std::string box =
            "box of " + std::to_string(static_cast<int>(size)) + " a";
          return spin(claims,
                      domain.name + ", " + box + ": ",
                      *solve(domain, box, Point<3>(size, size, size)));
        };
        const double small = cube(8.), middle = cube(16.), large = cube(32.);

        const std::string box     = "box of 80 a x 40 a x 20 a";
        const std::string title   = domain.name + ", " + box + ": ";
        const auto        problem = solve(domain, box, Point<3>(80., 40., 20.));
        const double      paper   = spin(claims, title, *problem);
        check_torque(claims, title, *problem);

        claims.near(domain.name +
                      ": the box of 32 a leaves half the shear rate",
                    large,
                    0.5,
                    1e-4);
        claims.near(domain.name + ": so does that of 80 a x 40 a x 20 a",
                    paper,
                    0.5,
                    1e-4);
        claims.near(domain.name + ": of twice the box an eighth is left",
                    (0.5 - middle) / (0.5 - small),
                    1. / 8.,
                    0.01);
        claims.near(domain.name + ": and of twice that",
                    (0.5 - large) / (0.5 - middle),
                    1. / 8.,
                    0.05);
      }
  });
}

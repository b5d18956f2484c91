// A particle that crosses a plane which bounds the meshed block, by period or
// by rotation, moves as it does in a block that leaves it whole.

#include <catena/flow/flow_solver.h>
#include <catena/flow/particle_forces.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/mesh/mesh_mover.h>

#include "../tests.h"

#include "../mesh/scenes.h"

using namespace dealii;
using namespace Catena;



template <int dim>
struct Result
{
  std::vector<RigidMotion<dim>> motions;
  /// of the fluid on the particles, zero for free particles
  double force;
};



template <int dim>
Result<dim>
free_motion(const Scene<dim> &scene, const unsigned int on_equator)
{
  scene.check();
  MeshParameters parameters = Tests::resolution(on_equator, 1);
  parameters.maximal_size   = 1.5;
  const MovingMesh<dim> mesh(MPI_COMM_WORLD,
                             scene,
                             generate_mesh<dim>(scene, parameters));
  Configuration<dim>    configuration;
  for (const auto &particle : scene.particles)
    configuration.centres.push_back(particle.centre);
  const RigidBodies<dim>     bodies(scene);
  const NewtonianStress<dim> stress;

  FlowSolverParameters controls;
  controls.tolerance = 1e-10;
  FlowSolver<dim> solver(controls);
  solver.reinit(mesh, bodies, configuration, false);
  solver.assemble(configuration, stress);
  FlowFields<dim> fields;
  fields.velocity = mesh.vector_field();
  fields.pressure = mesh.scalar_field();
  fields.motions  = reference_motions<dim>(scene, configuration, false);
  const unsigned int iterations =
    solver.solve(fields, {}, std::vector<double>(bodies.n_unknowns(), 0.));

  double force = 0.;
  for (const double f :
       particle_forces<dim>(mesh, bodies, configuration, stress, fields))
    force = std::max(force, std::abs(f));
  std::cout << mesh.n_global_cells() << " cells, quality " << mesh.quality()
            << ", " << iterations << " iterations" << std::endl;
  return {fields.motions, force};
}



template <int dim>
double
difference(const Result<dim> &a, const Result<dim> &b)
{
  double most = 0.;
  for (unsigned int i = 0; i < a.motions.size(); ++i)
    most = std::max(
      {most,
       (a.motions[i].velocity - b.motions[i].velocity).norm(),
       (a.motions[i].angular_velocity - b.motions[i].angular_velocity).norm()});
  return most;
}



/// Compare two layouts of the same scene on two meshes.
template <int dim>
void
compare(Tests::Claims     &claims,
        const std::string &name,
        const Scene<dim>  &whole,
        const Scene<dim>  &crossing,
        const unsigned int coarse,
        const unsigned int fine,
        const double       tolerance)
{
  double differences[2];
  for (unsigned int i = 0; i < 2; ++i)
    {
      const unsigned int on_equator = i == 0 ? coarse : fine;
      const auto         a          = free_motion<dim>(whole, on_equator);
      const auto         b          = free_motion<dim>(crossing, on_equator);
      differences[i]                = difference<dim>(a, b);
      claims.at_most(name + ", no force on a cut particle", b.force, 1e-6);
    }
  claims.at_most(name + ", coarse", differences[0], tolerance);
  claims.at_most(name + ", fine", differences[1], tolerance / 5.);
}



template <int dim>
Scene<dim>
box(const Symmetry symmetry)
{
  Scene<dim> scene;
  scene.length   = 16.;
  scene.height   = 10.;
  scene.width    = 6.;
  scene.symmetry = symmetry;
  return scene;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](auto &claims) {
    {
      Scene<2> whole         = box<2>(Symmetry::none);
      whole.particles        = {{Point<2>(1., 0.8)}, {Point<2>(4.5, -1.), 1.5}};
      Scene<2> crossing      = whole;
      crossing.window_centre = -6.6;
      compare<2>(
        claims, "a disc on the periodic line", whole, crossing, 24, 48, 6e-4);
    }
    {
      Scene<2> whole    = box<2>(Symmetry::quarter);
      whole.cut         = Cut::y_plane;
      whole.particles   = {{Tests::polar<2>(1.6, 60.)}};
      Scene<2> crossing = whole;
      crossing.cut      = Cut::x_plane;
      compare<2>(claims,
                 "a disc on the line of the rotation",
                 whole,
                 crossing,
                 24,
                 48,
                 6e-4);
    }
    {
      Scene<3> whole         = box<3>(Symmetry::half);
      whole.particles        = {{Point<3>(1., 0.8, 0.)},
                                {Point<3>(3.5, -1., 1.2), 0.8}};
      Scene<3> crossing      = whole;
      crossing.window_centre = -6.6;
      compare<3>(claims,
                 "a sphere on the periodic plane",
                 whole,
                 crossing,
                 16,
                 32,
                 2e-3);
    }
    {
      Scene<3> whole    = box<3>(Symmetry::quarter);
      whole.cut         = Cut::y_plane;
      whole.particles   = {{Tests::polar<3>(1.3, 60.)}};
      Scene<3> crossing = whole;
      crossing.cut      = Cut::x_plane;
      compare<3>(claims,
                 "a sphere on the plane of the rotation",
                 whole,
                 crossing,
                 16,
                 32,
                 2e-3);
    }
  });
}

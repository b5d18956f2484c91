// The log-conformation on a moving mesh, where the mesh alone moves against
// the fluid: a constant state stays constant while a particle drags the mesh
// about, with steps of different lengths, and a linear one stays what it was
// in space, which needs the mesh velocity to be that of the formula in time.

#include <catena/conformation/conformation_solver.h>
#include <catena/mesh/mesh_mover.h>

#include <string>

#include "../tests.h"

#include "../print.h"
#include "fields.h"

using namespace Catena;
using namespace Catena::Tests;

constexpr double solver_tolerance = 1e-13;

/// Steps of different lengths
const std::vector<double> steps = {0.08, 0.08, 0.04, 0.1, 0.1, 0.06};



/**
 * Takes a state from step to step while the nodes move.
 */
template <int dim>
class MovingState
{
public:
  MovingState(MovingMesh<dim>             &mesh,
              const double                 weissenberg_number,
              const TensorFunction<dim>   &state,
              const dealii::Tensor<1, dim> uniform_velocity)
    : mesh(mesh)
    , model(make_model(weissenberg_number))
    , solver(model, make_controls())
    , state(state)
    , velocity(interpolate_vector<dim>(mesh,
                                       mesh.positions(),
                                       [&](const dealii::Point<dim> &) {
                                         return uniform_velocity;
                                       }))
    , x_now(mesh.positions())
    , x_before(mesh.positions())
    , now(interpolate_tensor<dim>(mesh, mesh.positions(), state))
    , before(interpolate_tensor<dim>(mesh, mesh.positions(), state))
  {
    solver.reinit(mesh);
  }

  /// Take the nodes to @p x in a time dt.
  void
  move(const VectorType &x, const double dt)
  {
    time                    = time.next(dt);
    const BdfCoefficients a = time.bdf();
    VectorType            u = x;
    u.sadd(a.a0 / dt, a.a1 / dt, x_now);
    u.add(a.a2 / dt, x_before);
    u.update_ghost_values();
    mesh.set_positions(x);

    // no help from the first guess
    std::vector<VectorType> next(now.size(), mesh.scalar_field());
    solver.solve(next, now, before, velocity, u, time, [&](const auto &p) {
      return -1. *
             model.log_conformation_rate(dealii::Tensor<2, dim>(),
                                         spectral_decomposition<dim>(state(p)));
    });
    before   = now;
    now      = next;
    x_before = x_now;
    x_now    = x;
  }

  double
  error() const
  {
    return largest_error<dim>(mesh, x_now, now, state);
  }

private:
  MovingMesh<dim>          &mesh;
  const Giesekus<dim>       model;
  ConformationSolver<dim>   solver;
  const TensorFunction<dim> state;
  const VectorType          velocity;
  VectorType                x_now, x_before;
  std::vector<VectorType>   now, before;
  TimeStep                  time;

  static Giesekus<dim>
  make_model(const double weissenberg_number)
  {
    GiesekusParameters parameters;
    parameters.weissenberg_number = weissenberg_number;
    return Giesekus<dim>(parameters);
  }

  static ConformationSolverParameters
  make_controls()
  {
    ConformationSolverParameters parameters;
    parameters.tolerance = solver_tolerance;
    return parameters;
  }
};



/**
 * The error the solver may leave in steps.size() steps in a state of size 1:
 * its tolerance is relative to the norm of a right-hand side with the weight
 * of the volume at a vertex, so that it allows more at the smallest elements.
 * The last factor is that of the inverse of a mass matrix against the lumped
 * one.
 */
template <int dim>
double
error_of_solver(const MovingMesh<dim> &mesh)
{
  VectorType      volumes = mesh.scalar_field();
  CellValues<dim> values;
  for (const auto &cell : mesh.cells())
    {
      values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
      for (const auto &point : values.points())
        for (unsigned int v = 0; v < cell.vertices.size(); ++v)
          if (mesh.owned_scalars().is_element(cell.vertices[v]))
            volumes(cell.vertices[v]) += point.JxW * point.linear[v];
    }
  double smallest = volumes.linfty_norm();
  for (const auto vertex : mesh.owned_scalars())
    smallest = std::min(smallest, volumes(vertex));
  smallest = dealii::Utilities::MPI::min(smallest, mesh.communicator());
  return steps.size() * solver_tolerance * volumes.l2_norm() / smallest *
         (dim + 2);
}



/// A tensor without the components that vanish on mirror planes.
template <int dim>
dealii::SymmetricTensor<2, dim>
some_tensor(const double scale)
{
  dealii::SymmetricTensor<2, dim> s;
  s[0][0] = 1.5 * scale;
  s[0][1] = -0.6 * scale;
  for (unsigned int d = 1; d < dim; ++d)
    s[d][d] = -0.4 * d * scale;
  return s;
}



template <int dim>
void
check_constants(Claims            &claims,
                const std::string &name,
                const Scene<dim>  &scene)
{
  MeshParameters parameters;
  parameters.elements_on_equator = 12;
  parameters.elements_across_gap = 1;
  const MeshDescription<dim> description =
    generate_mesh<dim>(scene, parameters);

  for (const double scale : {0., 1.})
    for (const double speed : {0., 1.})
      {
        // the rotation turns a uniform velocity against itself
        if (speed > 0. && scene.rotational())
          continue;
        MovingMesh<dim>    mesh(MPI_COMM_WORLD, scene, description);
        Configuration<dim> configuration;
        for (const auto &particle : scene.particles)
          configuration.centres.push_back(particle.centre);
        const MeshMover<dim> mover(mesh, configuration);

        const auto             constant = some_tensor<dim>(scale);
        dealii::Tensor<1, dim> uniform;
        uniform[0] = speed;
        MovingState<dim> state(
          mesh, 1., [&](const auto &) { return constant; }, uniform);

        double t = 0., error = 0., travel = 0.;
        for (const double dt : steps)
          {
            t += dt;
            configuration.frame_angle = 0.6 * std::sin(t);
            for (unsigned int i = 0; i < scene.particles.size(); ++i)
              if (!scene.particles[i].on_axis)
                {
                  const auto start            = scene.particles[i].centre;
                  configuration.centres[i][0] = start[0] + 0.5 * t;
                  configuration.centres[i][1] =
                    start[1] + 0.4 * std::sin(5. * t);
                }
            const VectorType x = mover.positions(configuration);
            VectorType       moved(x);
            moved -= mesh.reference_positions();
            travel = std::max(travel, moved.linfty_norm());
            state.move(x, dt);
            error = std::max(error, state.error());
          }
        const std::string which =
          scale == 0. ? ", c = I stays" : ", a constant stays";
        const std::string flow = speed == 0. ? " at rest" : " in uniform flow";
        print(name,
              ": ",
              mesh.n_global_cells(),
              " elements, nodes moved by ",
              travel,
              ", smallest quality ",
              mesh.quality());
        claims.at_least(name + which + flow + ": the mesh moves", travel, 0.2);
        claims.at_most(name + which + flow, error, error_of_solver(mesh));
      }
}



/**
 * Node positions of a mesh without particles that is kneaded: walls, mirror
 * planes and the period stay, mid-nodes remain in the middle of their edges.
 */
template <int dim>
VectorType
kneaded(const MovingMesh<dim> &mesh, const double t)
{
  using dealii::numbers::PI;
  const Scene<dim> &scene     = mesh.scene();
  const auto        at_vertex = [&](const unsigned int node) {
    const auto   x = node_position<dim>(mesh.reference_positions(), node);
    const double a       = 2. * PI * x[0] / scene.length,
                 b       = PI * x[1] / scene.height;
    dealii::Point<dim> p = x;
    p[0] += 0.15 * std::sin(2. * t) * std::cos(a + t) * std::cos(b);
    p[1] += 0.15 * std::sin(3. * t) * std::sin(a) * std::cos(b);
    if (dim == 3)
      p[dim - 1] += 0.1 * std::sin(4. * t) * std::cos(a) * std::sin(b) *
                    std::sin(2. * PI * x[dim - 1] / scene.width);
    return p;
  };
  VectorType positions = mesh.vector_field();
  for (const auto node : mesh.owned_nodes())
    {
      const auto &ends = mesh.edge_ends(node);
      const auto  a = at_vertex(ends[0]), b = at_vertex(ends[1]);
      for (unsigned int d = 0; d < dim; ++d)
        positions(dim * node + d) = (a[d] + b[d]) / 2.;
    }
  positions.update_ghost_values();
  return positions;
}



template <int dim>
void
check_linear(Claims &claims, const std::string &name)
{
  Scene<dim> scene;
  scene.length   = 2.;
  scene.height   = 2.;
  scene.width    = 2.;
  scene.symmetry = dim == 3 ? Symmetry::half : Symmetry::none;
  MovingMesh<dim> mesh(MPI_COMM_WORLD, scene, uniform_mesh(scene, 0.3));
  mesh.set_positions(kneaded(mesh, 0.));

  // linear where it is free to be, across the walls; no relaxation
  const auto linear = [](const dealii::Point<dim> &p) {
    return (1. + 0.7 * p[1] + (dim == 3 ? 0.5 * p[dim - 1] : 0.)) *
           some_tensor<dim>(1.);
  };
  MovingState<dim> state(mesh, 1e12, linear, dealii::Tensor<1, dim>());
  double           t = 0., error = 0., travel = 0.;
  for (const double dt : steps)
    {
      t += dt;
      const VectorType x = kneaded(mesh, t);
      VectorType       moved(x);
      moved -= mesh.reference_positions();
      travel = std::max(travel, moved.linfty_norm());
      state.move(x, dt);
      error = std::max(error, state.error());
    }
  print(name,
        ": ",
        mesh.n_global_cells(),
        " elements, nodes moved by ",
        travel,
        ", smallest quality ",
        mesh.quality());
  claims.at_least(name + ", a linear state stays: the mesh moves", travel, 0.1);
  claims.at_most(name + ", a linear state stays",
                 error,
                 2. * error_of_solver(mesh));
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    Scene<2> plane;
    plane.length    = 8.;
    plane.height    = 6.;
    plane.particles = {{dealii::Point<2>(-0.3, 0.2)}};
    check_constants<2>(claims, "dim 2, a disc", plane);

    plane.length    = 12.;
    plane.symmetry  = Symmetry::quarter;
    plane.particles = {{dealii::Point<2>(), 1., true},
                       {dealii::Point<2>(2.6, 0.5)}};
    check_constants<2>(claims, "dim 2, discs in the quarter domain", plane);

    Scene<3> space;
    space.length    = 6.;
    space.height    = 6.;
    space.width     = 5.;
    space.symmetry  = Symmetry::half;
    space.particles = {{dealii::Point<3>(-0.3, 0.2, 0.)}};
    check_constants<3>(claims, "dim 3, a sphere", space);

    check_linear<2>(claims, "dim 2, no particle");
    check_linear<3>(claims, "dim 3, no particle");
  });
}

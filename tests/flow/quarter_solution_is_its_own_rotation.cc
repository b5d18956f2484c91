// Three particles in a Newtonian fluid, of which the rotational symmetry leaves
// the middle one's half and an outer one. On the identified planes velocity,
// pressure and the forces of both sides match; the cut at x = 0 and the cut at
// y = 0 give the same flow; and so does the mesh with all three particles. What
// differs falls at least with the square of the element size.

#include <catena/mesh/field_transfer.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

/// The outer particle is clear of both cuts.
template <int dim>
Scene<dim>
make_scene(const Symmetry symmetry, const Cut cut)
{
  Scene<dim> scene = Tests::three_particles<dim>(3., 50., cut);
  scene.length     = 20.;
  scene.height     = 16.;
  scene.width      = 8.;
  scene.symmetry   = symmetry;
  if (symmetry != Symmetry::quarter)
    {
      scene.particles[0].on_axis = false;
      scene.particles.push_back({Tests::polar<dim>(3., 230.)});
    }
  return scene;
}



template <int dim>
void
check_identified_nodes(Tests::Claims                   &claims,
                       const std::string               &title,
                       const Tests::StokesProblem<dim> &problem)
{
  const MovingMesh<dim>    &mesh           = problem.mesh;
  const NodeIdentification &identification = mesh.identification();
  const auto                reactions      = Tests::nodal_reactions(problem);
  const unsigned int        n_nodes        = mesh.n_global_nodes();

  double velocity = 0., pressure = 0., largest_reaction = 0.;
  std::vector<Tensor<1, dim>> sums(n_nodes);
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      const unsigned int master = identification.master(i);
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double factor = identification.vector_factor(i, d);
          velocity            = std::max(velocity,
                              std::abs(problem.fields.velocity(dim * i + d) -
                                       factor * problem.fields.velocity(
                                                  dim * master + d)));
          // the balance of what is free to move
          if (mesh.particle(i) == mesh.no_particle && !mesh.on_wall(i) &&
              !(d == 2 && mesh.on_mirror(i)))
            {
              sums[master][d] += factor * reactions[i][d];
              if (master != i)
                largest_reaction =
                  std::max(largest_reaction, std::abs(reactions[i][d]));
            }
        }
      const unsigned int vertex = mesh.vertex_of_node(i);
      if (vertex != numbers::invalid_unsigned_int)
        pressure = std::max(pressure,
                            std::abs(problem.fields.pressure(vertex) -
                                     problem.fields.pressure(
                                       mesh.vertex_of_node(master))));
    }

  double imbalance = 0.;
  for (const auto &sum : sums)
    imbalance = std::max(imbalance, sum.norm() / largest_reaction);

  claims.at_most(title + "velocities match on identified planes",
                 velocity,
                 1e-12);
  claims.at_most(title + "pressures match on identified planes",
                 pressure,
                 1e-12);
  claims.at_most(title + "forces on identified planes are opposite",
                 imbalance,
                 1e-7);
}



/// How far two solutions of the same flow are apart.
struct Difference
{
  double motions = 0., velocity = 0., pressure = 0.;
};



/**
 * The particles 0 and 1 of both are the same. Velocity and pressure are
 * compared in the mean square over the nodes of the @p second, the velocity
 * against the disturbance of the shear.
 */
template <int dim>
Difference
difference(const Tests::StokesProblem<dim> &first,
           const Tests::StokesProblem<dim> &second)
{
  Difference result;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const auto &a = first.fields.motions[i], &b = second.fields.motions[i];
      result.motions =
        std::max({result.motions,
                  (a.velocity - b.velocity).norm(),
                  (a.angular_velocity - b.angular_velocity).norm()});
    }

  const FieldTransfer<dim> transfer(first.mesh,
                                    first.mesh.positions(),
                                    second.mesh,
                                    second.mesh.positions());
  const VectorType         velocity = transfer.vector(first.fields.velocity);
  const VectorType         pressure = transfer.scalar(first.fields.pressure);

  double error = 0., square = 0.;
  for (const auto node : second.mesh.owned_nodes())
    {
      const auto imposed = Scene<dim>::imposed_velocity(second.position(node));
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = second.fields.velocity(dim * node + d);
          error += std::pow(velocity(dim * node + d) - u, 2);
          square += std::pow(u - imposed[d], 2);
        }
    }
  result.velocity = std::sqrt(error / square);

  VectorType pressure_error = pressure;
  pressure_error -= second.fields.pressure;
  pressure_error.add(-pressure_error.mean_value());
  result.pressure = pressure_error.l2_norm() / second.fields.pressure.l2_norm();
  return result;
}



/// The same flow three times: both cuts of the box, and without a cut.
template <int dim>
struct Solutions
{
  std::unique_ptr<Tests::StokesProblem<dim>> x_cut, y_cut, whole;
};



template <int dim>
Solutions<dim>
solve(const unsigned int elements_on_equator)
{
  MeshParameters parameters = Tests::resolution(elements_on_equator, 1);
  parameters.maximal_size   = 2.;

  const auto make = [&](const Symmetry symmetry, const Cut cut) {
    auto problem = std::make_unique<Tests::StokesProblem<dim>>(
      make_scene<dim>(symmetry, cut), parameters);
    const unsigned int n_iterations = problem->solve();
    Tests::print(problem->mesh.n_global_cells(),
                 " cells, ",
                 n_iterations,
                 " iterations");
    for (const auto &motion : problem->fields.motions)
      Tests::print("  velocity ",
                   motion.velocity,
                   ", angular velocity ",
                   motion.angular_velocity);
    return problem;
  };
  return {make(Symmetry::quarter, Cut::x_plane),
          make(Symmetry::quarter, Cut::y_plane),
          make(dim == 3 ? Symmetry::half : Symmetry::none, Cut::x_plane)};
}



/**
 * Are the two solutions on the finer meshes closer than @p bound, and closer
 * than those on the coarser ones by the order of the elements?
 */
template <int dim>
void
compare(Tests::Claims                   &claims,
        const std::string               &title,
        const Tests::StokesProblem<dim> &coarse_first,
        const Tests::StokesProblem<dim> &coarse_second,
        const Tests::StokesProblem<dim> &fine_first,
        const Tests::StokesProblem<dim> &fine_second,
        const Difference                &bound)
{
  const Difference coarse = difference(coarse_first, coarse_second);
  const Difference fine   = difference(fine_first, fine_second);
  const auto       order  = [&](const double error, const double finer_error) {
    return Tests::order(error,
                        finer_error,
                        std::pow(coarse_second.mesh.n_global_cells(),
                                 -1. / dim),
                        std::pow(fine_second.mesh.n_global_cells(), -1. / dim));
  };
  Tests::print("  on coarser meshes motions ",
               coarse.motions,
               ", velocity ",
               coarse.velocity,
               ", pressure ",
               coarse.pressure,
               ", orders ",
               order(coarse.motions, fine.motions),
               ", ",
               order(coarse.velocity, fine.velocity),
               ", ",
               order(coarse.pressure, fine.pressure));

  claims.at_most(title + ", motions", fine.motions, bound.motions);
  claims.at_most(title + ", velocity", fine.velocity, bound.velocity);
  claims.at_most(title + ", pressure", fine.pressure, bound.pressure);
  claims.at_least(title + ", ever more so on finer meshes",
                  order(coarse.velocity, fine.velocity),
                  2.);
}



template <int dim>
void
check(Tests::Claims     &claims,
      const unsigned int coarse_elements,
      const unsigned int fine_elements,
      const Difference  &bound)
{
  const std::string name   = " (" + std::to_string(dim) + "D)";
  const auto        coarse = solve<dim>(coarse_elements);
  const auto        fine   = solve<dim>(fine_elements);

  check_identified_nodes(claims, "cut at x = 0" + name + ": ", *fine.x_cut);
  check_identified_nodes(claims, "cut at y = 0" + name + ": ", *fine.y_cut);
  compare(claims,
          "both cuts give the same flow" + name,
          *coarse.x_cut,
          *coarse.y_cut,
          *fine.x_cut,
          *fine.y_cut,
          bound);
  compare(claims,
          "cut at x = 0 and whole box agree" + name,
          *coarse.whole,
          *coarse.x_cut,
          *fine.whole,
          *fine.x_cut,
          bound);
  compare(claims,
          "cut at y = 0 and whole box agree" + name,
          *coarse.whole,
          *coarse.y_cut,
          *fine.whole,
          *fine.y_cut,
          bound);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check<2>(claims, 48, 96, {1e-5, 4e-4, 5e-3});
    check<3>(claims, 16, 32, {5e-4, 1e-2, 0.15});
  });
}

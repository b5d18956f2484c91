// Elements as coarse as their particles are curved, in gaps that the mesh is
// pressed in: a new mesh has a positive Jacobian everywhere, with straight
// cells that would fit and curved ones that would not.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>

#include "../tests.h"

#include "../verification/spheres_in_a_line.h"

using namespace dealii;
using namespace Catena;

/// The smallest Jacobian at the nodes and at Gauss points.
double
smallest_jacobian(const MovingMesh<3> &mesh)
{
  const FE_SimplexP<3>   element(2);
  const Quadrature<3>    nodes(element.get_unit_support_points());
  const QGaussSimplex<3> gauss(4);

  double smallest = std::numeric_limits<double>::max();
  for (const Quadrature<3> *quadrature :
       {&nodes, static_cast<const Quadrature<3> *>(&gauss)})
    {
      FEValues<3> values(mesh.mapping(),
                         element,
                         *quadrature,
                         update_jacobians);
      for (const auto &cell : mesh.cells())
        {
          values.reinit(cell.iterator);
          for (const unsigned int q : values.quadrature_point_indices())
            smallest =
              std::min(smallest, determinant(Tensor<2, 3>(values.jacobian(q))));
        }
    }
  return smallest;
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    SimulationParameters parameters;
    parameters.mesh             = Tests::resolution(12, 1);
    parameters.mesh.gap_stretch = 3.;

    double       smallest   = std::numeric_limits<double>::max();
    unsigned int n_attempts = 0, n_meshes = 0;
    for (const unsigned int n : {2, 3})
      for (const Symmetry symmetry : {Symmetry::quarter, Symmetry::half})
        for (const double distance : {2.2, 2.3, 2.6})
          for (const double degrees : {10., 30.})
            {
              const Scene<3> scene =
                Tests::Line{n, distance, degrees, 0.25, symmetry}.scene();
              scene.check();
              Configuration<3> configuration;
              for (const auto &particle : scene.particles)
                configuration.centres.push_back(particle.centre);
              configuration.frame_angle = degrees * numbers::PI / 180.;

              const auto discretization =
                Remesher<3>(scene, parameters, MPI_COMM_WORLD)
                  .make(configuration);
              smallest =
                std::min(smallest, smallest_jacobian(*discretization.mesh));
              n_attempts += discretization.attempts;
              ++n_meshes;
            }
    std::cout << n_meshes << " meshes in " << n_attempts << " attempts"
              << std::endl;
    claims.at_least("the smallest Jacobian is positive", smallest, 1e-12);
    claims.holds("it took more than one attempt at some of them",
                 n_attempts > n_meshes);
  });
}

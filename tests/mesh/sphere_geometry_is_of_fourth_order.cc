// The quadratic elements take away the volume of the particle from the box, and
// show its surface, with errors of order 4: with straight elements it would be
// 2.

#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include "../tests.h"

#include "../print.h"
#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// Volume of the fluid, with the rules that assembly uses.
template <int dim>
double
fluid_volume(const MovingMesh<dim> &mesh)
{
  CellValues<dim> values;
  double          volume = 0.;
  for (const auto &cell : mesh.cells())
    {
      values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
      for (const auto &point : values.points())
        volume += point.JxW;
    }
  return volume;
}



template <int dim>
double
particle_surface(const MovingMesh<dim> &mesh)
{
  const QGaussSimplex<dim - 1> quadrature(3);
  FEFaceValues<dim>            values(mesh.mapping(),
                           mesh.scalar_dofs().get_fe(),
                           quadrature,
                           update_JxW_values);

  double area = 0.;
  for (const auto &cell : mesh.scalar_dofs().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() &&
          cell->face(f)->boundary_id() == BoundaryIds::particle)
        {
          values.reinit(cell, f);
          for (const unsigned int q : values.quadrature_point_indices())
            area += values.JxW(q);
        }
  return area;
}



template <int dim>
void
check(Tests::Claims                   &claims,
      const std::string               &name,
      const Symmetry                   symmetry,
      const std::vector<unsigned int> &elements_on_equator)
{
  Scene<dim> scene;
  scene.length    = 8.;
  scene.height    = 8.;
  scene.width     = 8.;
  scene.symmetry  = symmetry;
  scene.particles = {{Point<dim>(), 1., symmetry == Symmetry::quarter}};

  double box = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    box *= scene.upper()[d] - scene.lower()[d];
  const double exact_volume = dim == 2 ? numbers::PI : 4. / 3. * numbers::PI;
  const double exact_area   = dim == 2 ? 2. * numbers::PI : 4. * numbers::PI;
  const double share        = 1. / scene.multiplicity(0);

  const std::string   title = name + " (" + std::to_string(dim) + "D): ";
  std::vector<double> volume_errors, area_errors;
  for (const unsigned int n : elements_on_equator)
    {
      const MovingMesh<dim> mesh(MPI_COMM_WORLD,
                                 scene,
                                 generate_mesh(scene, Tests::resolution(n, 1)));
      volume_errors.push_back(
        std::abs((box - fluid_volume(mesh)) / (share * exact_volume) - 1.));
      area_errors.push_back(
        std::abs(particle_surface(mesh) / (share * exact_area) - 1.));
      Tests::print(title,
                   n,
                   " elements on the equator, errors: volume ",
                   volume_errors.back(),
                   ", area ",
                   area_errors.back());
    }

  const auto order = [&](const std::vector<double> &errors) {
    const unsigned int n = errors.size() - 1;
    return std::log(errors[n - 1] / errors[n]) /
           std::log(1. * elements_on_equator[n] / elements_on_equator[n - 1]);
  };
  claims.at_least(title + "the volume of the particle is of order 4",
                  order(volume_errors),
                  3.7);
  claims.at_least(title + "the surface of the particle is of order 4",
                  order(area_errors),
                  3.7);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const std::vector<unsigned int> n = {16, 32, 64};
    check<2>(claims, "whole disc", Symmetry::none, n);
    check<2>(claims, "half of a disc", Symmetry::quarter, n);
    check<3>(claims, "whole sphere", Symmetry::none, n);
    check<3>(claims, "half of a sphere", Symmetry::half, n);
    check<3>(claims, "quarter of a sphere", Symmetry::quarter, n);
  });
}

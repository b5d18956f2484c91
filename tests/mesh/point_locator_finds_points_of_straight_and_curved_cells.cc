// Random points of random cells of a real mesh are found again, in a cell that
// maps back to them; points just inside a particle get a nearby cell.

#include <catena/mesh/point_locator.h>

#include <chrono>
#include <random>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

template <int dim>
using Nodes = std::array<Point<dim>, n_quadratic_nodes(dim)>;

template <int dim>
Point<dim>
map(const Nodes<dim> &x, const Point<dim> &unit)
{
  const auto values = quadratic_shape_values(unit);
  Point<dim> p;
  for (unsigned int i = 0; i < x.size(); ++i)
    p += values[i] * x[i];
  return p;
}

template <int dim>
double
smallest_jacobian_ratio(const std::vector<Nodes<dim>> &cells)
{
  double smallest = 1.;
  for (const auto &x : cells)
    {
      double low = std::numeric_limits<double>::max(), high = 0.;
      for (unsigned int v = 0; v < x.size(); ++v)
        {
          // vertices and middles of edges of the reference simplex
          std::array<Point<dim>, dim + 1> corners;
          for (unsigned int d = 0; d < dim; ++d)
            corners[d + 1][d] = 1.;
          Point<dim> unit;
          if (v <= dim)
            unit = corners[v];
          else
            unit = Point<dim>((corners[simplex_edge(v - dim - 1)[0]] +
                               corners[simplex_edge(v - dim - 1)[1]]) /
                              2.);
          const auto     gradients = quadratic_shape_gradients(unit);
          Tensor<2, dim> jacobian;
          for (unsigned int i = 0; i < x.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              jacobian[d] += x[i][d] * gradients[i];
          low  = std::min(low, determinant(jacobian));
          high = std::max(high, determinant(jacobian));
        }
      smallest = std::min(smallest, low / high);
    }
  return smallest;
}

template <int dim>
void
find_points(Tests::Claims &claims, const bool curved)
{
  const auto        scene = Tests::three_particles<dim>();
  const auto        mesh  = generate_mesh(scene, Tests::resolution(32, 2));
  const auto        cells = Tests::quadratic_nodes(scene, mesh, curved);
  const std::string in = std::string(curved ? " (curved, " : " (straight, ") +
                         std::to_string(dim) + "D)";
  claims.at_least("no cell is inverted" + in,
                  smallest_jacobian_ratio<dim>(cells),
                  0.05);

  const PointLocator<dim>             locator(cells);
  std::mt19937                        generator(1);
  std::exponential_distribution<>     exponential;
  std::uniform_int_distribution<long> any_cell(0, cells.size() - 1);

  const unsigned int n         = 20000;
  double             violation = 0., error = 0.;
  const auto         start = std::chrono::steady_clock::now();
  for (unsigned int k = 0; k < n; ++k)
    {
      Point<dim> unit;
      double     sum = exponential(generator);
      for (unsigned int d = 0; d < dim; ++d)
        sum += (unit[d] = exponential(generator));
      unit /= sum;

      const Point<dim> p     = map<dim>(cells[any_cell(generator)], unit);
      const auto       found = locator.locate(p);
      violation              = std::max(violation, found.violation);
      error =
        std::max(error, p.distance(map<dim>(cells[found.cell], found.unit)));
    }
  std::cout << n / std::chrono::duration<double>(
                     std::chrono::steady_clock::now() - start)
                     .count()
            << " points per second" << std::endl;
  claims.at_most("points are found inside a cell" + in, violation, 1e-9);
  claims.at_most("the cell maps back to the point" + in, error, 1e-10);

  // points inside of the outer particle by 1e-3 radii
  double outside = 0.;
  for (double angle = 0.; angle < 360.; angle += 7.)
    {
      const auto p = scene.particles[1].centre +
                     Tensor<1, dim>(Tests::polar<dim>(1. - 1e-3, angle));
      outside = std::max(outside, locator.locate(p).violation);
    }
  claims.at_most("points beside the mesh get a nearby cell" + in, outside, 0.2);
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const bool curved : {false, true})
      {
        find_points<2>(claims, curved);
        find_points<3>(claims, curved);
      }
  });
}

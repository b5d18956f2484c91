// A straight line across the gap between two particles crosses at least n_min
// cells, and elements along the equators have the size 2 pi a/n_part.

#include <catena/mesh/point_locator.h>

#include <set>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

template <int dim>
unsigned int
cells_across(const Scene<dim>           &scene,
             const MeshDescription<dim> &mesh,
             const double                gap)
{
  const PointLocator<dim> locator(Tests::quadratic_nodes(scene, mesh, true));
  const unsigned int      n_samples = 1000;
  const Point<dim>        outer     = scene.particles[1].centre;
  const Tensor<1, dim>    direction = outer / outer.norm();
  std::set<unsigned int>  cells;
  for (unsigned int i = 1; i < n_samples; ++i)
    {
      // slightly beside the line, which may follow edges of cells
      Point<dim> p = Point<dim>((1. + gap * i / n_samples) * direction);
      p[dim - 1] += dim == 3 ? 1e-4 * gap : 0.;
      cells.insert(locator.locate(p).cell);
    }
  return cells.size();
}

/// Mean length of the edges of particle 1 in the plane z = 0.
template <int dim>
double
equator_size(const Scene<dim> &scene, const MeshDescription<dim> &mesh)
{
  double                                          length = 0.;
  std::set<std::pair<unsigned int, unsigned int>> edges;
  for (const auto &face : boundary_faces(mesh))
    if (face.boundary_id == BoundaryIds::particle + 1)
      for (const unsigned int a : face.vertices)
        for (const unsigned int b : face.vertices)
          {
            const Point<dim> &p = mesh.vertices[a], &q = mesh.vertices[b];
            const bool        in_plane =
              dim == 2 || (p[dim - 1] == 0. && q[dim - 1] == 0.);
            // the half that faces away from the gap
            const bool away = p.norm() > scene.particles[1].centre.norm() &&
                              q.norm() > scene.particles[1].centre.norm();
            if (a < b && in_plane && away && edges.insert({a, b}).second)
              length += p.distance(q);
          }
  return length / edges.size();
}

template <int dim>
void
check(Tests::Claims &claims)
{
  for (const double gap : {0.04, 0.2})
    for (const unsigned int across : {1U, 2U, 3U})
      {
        const auto scene      = Tests::three_particles<dim>(2. + gap);
        const auto parameters = Tests::resolution(32 * across, across);
        const auto mesh       = generate_mesh(scene, parameters);

        std::ostringstream where;
        where << " (" << dim << "D, gap " << gap << ", n_min " << across << ')';
        claims.at_least("n_min cells lie across the gap" + where.str(),
                        cells_across(scene, mesh, gap),
                        across);
        claims.near("the equator has n_part elements" + where.str(),
                    equator_size(scene, mesh) * 32. * across /
                      (2. * numbers::PI),
                    1.,
                    0.15);
      }
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check<2>(claims);
    check<3>(claims);
  });
}

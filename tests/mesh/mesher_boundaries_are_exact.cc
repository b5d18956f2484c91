// For every symmetry and cut: all boundary faces have an id, vertices lie on
// the planes and particles their ids tell, the meshes of identified planes are
// images of each other, and no volume is missing.

#include <catena/mesh/quality.h>

#include <deal.II/grid/tria.h>

#include <set>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// Distance of the vertices from where their boundary ids say they are.
template <int dim>
double
distance_to_boundary(const Scene<dim> &scene, const MeshDescription<dim> &mesh)
{
  double distance = 0.;
  for (const auto &face : boundary_faces(mesh))
    for (const unsigned int v : face.vertices)
      {
        const Point<dim>  &p  = mesh.vertices[v];
        const unsigned int id = face.boundary_id;
        if (id < 2 * dim)
          distance = std::max(distance,
                              std::abs(p[id / 2] - (id % 2 == 0 ?
                                                      scene.lower() :
                                                      scene.upper())[id / 2]));
        else
          {
            const auto &particle = scene.particles[id - BoundaryIds::particle];
            distance =
              std::max(distance,
                       std::abs(p.distance(particle.centre) - particle.radius));
          }
      }
  return distance;
}

/// Largest distance of a face of identified planes from the image of another.
template <int dim>
double
mismatch(const Scene<dim> &scene, const MeshDescription<dim> &mesh)
{
  double worst = 0.;
  for (const auto &identification : scene.identifications())
    for (const auto &face : boundary_faces(mesh))
      if (face.boundary_id == identification.from)
        {
          double nearest = std::numeric_limits<double>::max();
          for (const auto &other : boundary_faces(mesh))
            if (other.boundary_id == identification.to)
              for (const double move :
                   {0., identification.period, -identification.period})
                {
                  double distance = 0.;
                  for (const unsigned int v : face.vertices)
                    {
                      auto image = identification.image(mesh.vertices[v]);
                      image[0] += move;
                      double vertex = std::numeric_limits<double>::max();
                      for (const unsigned int w : other.vertices)
                        vertex =
                          std::min(vertex, image.distance(mesh.vertices[w]));
                      distance = std::max(distance, vertex);
                    }
                  nearest = std::min(nearest, distance);
                }
          worst = std::max(worst, nearest);
        }
  return worst;
}

/// Volume of the mesh over that of the box less the particles.
template <int dim>
double
volume_ratio(const Scene<dim> &scene, const MeshDescription<dim> &mesh)
{
  double volume = 0.;
  for (const auto &cell : mesh.cells)
    {
      std::array<Point<dim>, dim + 1> vertices;
      for (unsigned int v = 0; v <= dim; ++v)
        vertices[v] = mesh.vertices[cell.vertices[v]];
      volume += simplex_volume<dim>(vertices);
    }

  double exact = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    exact *= scene.upper()[d] - scene.lower()[d];
  for (unsigned int i = 0; i < scene.particles.size(); ++i)
    exact -= (dim == 3 ? 4. / 3. : 1.) * numbers::PI / scene.multiplicity(i);
  return volume / exact;
}

template <int dim>
void
check(Tests::Claims &claims, const std::string &name, const Scene<dim> &scene)
{
  scene.check();
  const auto        mesh  = generate_mesh(scene, Tests::resolution(24, 1));
  const std::string title = name + " (" + std::to_string(dim) + "D): ";

  Triangulation<dim> triangulation;
  triangulation.create_triangulation(mesh.vertices, mesh.cells, mesh.boundary);
  unsigned int n_faces = 0;
  for (const auto &face : triangulation.active_face_iterators())
    n_faces += face->at_boundary() ? 1 : 0;
  claims.holds(title + "all boundary faces have an id",
               n_faces == boundary_faces(mesh).size());

  std::set<types::boundary_id> expected, found;
  for (unsigned int i = 0; i < 2 * dim; ++i)
    expected.insert(i);
  for (unsigned int i = 0; i < scene.particles.size(); ++i)
    expected.insert(BoundaryIds::particle + i);
  for (const auto &face : boundary_faces(mesh))
    found.insert(face.boundary_id);
  claims.holds(title + "planes and particles all appear", found == expected);

  claims.at_most(title + "vertices are on planes and particles",
                 distance_to_boundary(scene, mesh),
                 1e-14);
  claims.at_most(title + "identified planes match",
                 mismatch(scene, mesh),
                 1e-13);
  claims.near(title + "no volume is missing",
              volume_ratio(scene, mesh),
              1.,
              1e-3);
  claims.at_least(title + "no bad cell", mesh.quality, 0.1);
}

template <int dim>
void
check_all(Tests::Claims &claims)
{
  check(claims, "no symmetry", Tests::two_particles<dim>(Symmetry::none));
  if (dim == 3)
    check(claims, "half", Tests::two_particles<dim>(Symmetry::half));
  check(claims, "cut at x = 0", Tests::three_particles<dim>());

  auto scene = Tests::three_particles<dim>(2.04, 80., Cut::y_plane);
  check(claims, "cut at y = 0", scene);
  scene.window_centre = 10.;
  check(claims, "cut at y = 0, window moved up", scene);
  scene.window_centre = -7.3;
  check(claims, "cut at y = 0, window moved down", scene);

  scene           = Scene<dim>();
  scene.symmetry  = Symmetry::quarter;
  scene.particles = {{Tests::polar<dim>(1.02, 10.)}};
  check(claims, "particle close to the cut", scene);
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check_all<2>(claims);
    check_all<3>(claims);
  });
}

// A pair of particles, free and at the smallest gap, in the half of the box and
// in the quarter: on a mesh of the half that is the mesh of the quarter twice,
// turned by half a turn about z, motions and contact force are the same.

#include <catena/mesh/boundary_snapper.h>
#include <catena/particles/contacts.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;



template <int dim>
Scene<dim>
pair_in(const Symmetry symmetry, const double degrees)
{
  Scene<dim> scene;
  scene.length    = 20.;
  scene.height    = 16.;
  scene.width     = 8.;
  scene.symmetry  = symmetry;
  scene.particles = {{Tests::polar<dim>(1.05, degrees)}};
  if (symmetry != Symmetry::quarter)
    scene.particles.push_back({-scene.particles[0].centre});
  return scene;
}



/// The boundary after half a turn about z. Surface 0 is that of the particle,
/// surface 1 that of its image, where the quarter has a part of it.
types::boundary_id
turned(const types::boundary_id id)
{
  using namespace BoundaryIds;
  if (id == x_high)
    return x_low;
  if (id == y_low || id == y_high)
    return id == y_low ? y_high : y_low;
  if (id >= particle)
    return id == particle ? particle + 1 : particle;
  return id;
}



/**
 * The mesh of a block x >= 0 with its image under half a turn about z, joined
 * on x = 0.
 */
template <int dim>
MeshDescription<dim>
twice(const MeshDescription<dim> &mesh)
{
  MeshDescription<dim> result = mesh;

  std::vector<unsigned int> image;
  const unsigned int        n = mesh.vertices.size();
  std::vector<unsigned int> on_plane;
  for (unsigned int v = 0; v < n; ++v)
    if (mesh.vertices[v][0] == 0.)
      on_plane.push_back(v);
  for (unsigned int v = 0; v < n; ++v)
    {
      const Point<dim> p = Image<dim>{true}(mesh.vertices[v]);
      image.push_back(result.vertices.size());
      if (p[0] == 0.)
        for (const unsigned int w : on_plane)
          if (mesh.vertices[w].distance(p) < 1e-9)
            image[v] = w;
      if (image[v] == result.vertices.size())
        result.vertices.push_back(p);
    }
  for (const auto &cell : mesh.cells)
    {
      result.cells.push_back(cell);
      for (unsigned int &v : result.cells.back().vertices)
        v = image[v];
    }

  auto &faces = boundary_faces(result);
  faces.clear();
  MeshDescription<dim> copy = mesh;
  for (const auto &face : boundary_faces(copy))
    if (face.boundary_id != BoundaryIds::x_low)
      {
        faces.push_back(face);
        faces.push_back(face);
        faces.back().boundary_id = turned(face.boundary_id);
        for (unsigned int &v : faces.back().vertices)
          v = image[v];
      }
  return result;
}



template <int dim>
void
compare(Tests::Claims &claims, const double degrees, const bool held)
{
  MeshParameters parameters      = Tests::resolution(16, 1);
  parameters.maximal_size        = 2.5;
  const Scene<dim> quarter_scene = pair_in<dim>(Symmetry::quarter, degrees);
  const Scene<dim> half_scene =
    pair_in<dim>(dim == 3 ? Symmetry::half : Symmetry::none, degrees);
  const auto mesh = generate_mesh<dim>(quarter_scene, parameters);

  Tests::StokesProblem<dim> quarter(quarter_scene, mesh, 1e-12);
  Tests::StokesProblem<dim> half(half_scene, twice<dim>(mesh), 1e-12);
  const auto                solve = [&](Tests::StokesProblem<dim> &problem,
                         const Scene<dim>          &scene) {
    std::vector<Contact<dim>> candidates;
    if (held)
      {
        Contacts<dim> contacts(scene, 0.05 + 1e-12);
        contacts.enforce(problem.configuration);
        candidates = contacts.candidates(problem.configuration);
      }
    problem.solve(std::vector<double>(problem.bodies.n_unknowns(), 0.),
                  candidates);
    return problem.fields;
  };
  const auto a = solve(quarter, quarter_scene), b = solve(half, half_scene);

  std::ostringstream name;
  name << dim << "D, " << degrees << " degrees, "
       << quarter_scene.surfaces().size() << " surfaces in the quarter, "
       << (held ? "held" : "free");
  double difference = 0.;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const double sign = i == 0 ? 1. : -1.;
      difference =
        std::max({difference,
                  (a.motions[0].velocity - sign * b.motions[i].velocity).norm(),
                  std::abs(a.motions[0].angular_velocity[2] -
                           b.motions[i].angular_velocity[2])});
    }
  claims.at_most(name.str() + ": motions", difference, 1e-8);
  if (held)
    {
      claims.at_least(name.str() + ": repulsion", a.contact_forces.at(0), 0.1);
      claims.near(name.str() + ": force",
                  b.contact_forces.at(0) / a.contact_forces.at(0),
                  1.,
                  1e-7);
    }
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    // whole in the quarter, and across its plane
    for (const double degrees : {2., 40., 65.})
      for (const bool held : {false, true})
        {
          compare<2>(claims, degrees, held);
          compare<3>(claims, degrees, held);
        }
  });
}

// Parameters that make no mesh are refused by name before gmsh is called, and
// a quality that no attempt reaches ends in one line.

#include <catena/base/exceptions.h>
#include <catena/mesh/quality.h>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

bool
is_refused(const std::string &name, const std::string &value)
{
  MeshParameters   parameters;
  ParameterHandler handler;
  parameters.declare(handler);
  handler.set(name, value);
  try
    {
      parameters.check();
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      return message.find(name) != std::string::npos &&
             message.find('\n') == std::string::npos;
    }
  return false;
}

template <int dim>
double
regular_simplex_quality()
{
  std::array<Point<dim>, dim + 1> v;
  v[1][0] = 1.;
  v[2][0] = 0.5;
  v[2][1] = std::sqrt(0.75);
  if (dim == 3)
    {
      v[dim][0]       = 0.5;
      v[dim][1]       = std::sqrt(1. / 12.);
      v[dim][dim - 1] = std::sqrt(2. / 3.);
    }
  const double quality = simplex_quality<dim>(v);
  std::swap(v[0], v[1]);
  return std::abs(simplex_quality<dim>(v) + quality) < 1e-14 ? quality : 0.;
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    claims.near("a regular triangle has quality 1, inverted -1",
                regular_simplex_quality<2>(),
                1.,
                1e-14);
    claims.near("a regular tetrahedron has quality 1, inverted -1",
                regular_simplex_quality<3>(),
                1.,
                1e-14);

    claims.holds("a coarse equator is refused",
                 is_refused("Elements on equator", "3"));
    claims.holds("no element across the gap is refused",
                 is_refused("Elements across gap", "0"));
    claims.holds("a gap stretch below one is refused",
                 is_refused("Gap stretch", "0.5"));
    claims.holds("a negative growth is refused",
                 is_refused("Size growth", "-0.1"));
    claims.holds("a negative maximal size is refused",
                 is_refused("Maximal size", "-6"));
    claims.holds("an impossible quality is refused",
                 is_refused("Minimal quality", "0.9"));

    std::string    message;
    MeshParameters parameters  = Tests::resolution(8, 1);
    parameters.minimal_quality = 0.3;
    parameters.growth          = 1.;
    try
      {
        auto scene = Tests::two_particles<2>(Symmetry::none);
        // a particle that all but touches the end of the period
        scene.particles[0].centre = Point<2>(scene.length / 2. - 1.0001, 0.);
        generate_mesh(scene, parameters);
      }
    catch (const MeshError &error)
      {
        message = error.what();
      }
    claims.holds("failure is reported in one line that names the remedy",
                 message.find("Minimal quality") != std::string::npos &&
                   message.find('\n') == std::string::npos);
  });
}

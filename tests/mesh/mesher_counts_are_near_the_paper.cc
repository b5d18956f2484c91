// The meshes M1 to M3 of Jaensson, Hulsen & Anderson, J. Non-Newtonian Fluid
// Mech. 235 (2016), have about 5,000, 20,000 and 58,000 tetrahedra: at the held
// gap ours have as many up to 40 %, with one set of parameters.

#include "../tests.h"

#include "scenes.h"

using namespace Catena;

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    struct Mesh
    {
      std::string  name;
      unsigned int on_equator, across_gap;
      double       published;
    };
    const std::vector<Mesh> meshes = {{"M1", 32, 1, 5000.},
                                      {"M2", 64, 2, 20000.},
                                      {"M3", 96, 3, 58000.}};
    const auto              scene  = Tests::three_particles<3>(2.04);
    for (const Mesh &m : meshes)
      {
        const auto mesh =
          generate_mesh(scene, Tests::resolution(m.on_equator, m.across_gap));
        claims.near(m.name + " has as many cells as the paper's",
                    mesh.cells.size(),
                    m.published,
                    0.4 * m.published);
        claims.at_least(m.name + " has no bad cell", mesh.quality, 0.1);
      }
  });
}

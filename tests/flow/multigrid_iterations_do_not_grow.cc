// From the imposed flow as first guess, the iterations of the flow solver
// hardly depend on the size of the elements, on the gap between the particles,
// and on whether the box is cut along identified planes.

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace Catena;



unsigned int
iterations(const Scene<3>    &scene,
           const unsigned int on_equator,
           const unsigned int across_gap = 1)
{
  Tests::StokesProblem<3> problem(scene,
                                  Tests::resolution(on_equator, across_gap),
                                  1e-8);
  const unsigned int      n = problem.solve();
  Tests::print(problem.mesh.n_global_cells(), " cells: ", n, " iterations");
  return n;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    struct Case
    {
      std::string name;
      Scene<3>    narrow, wide;
    };
    const std::vector<Case> cases = {
      {"uncut",
       Tests::two_particles<3>(Symmetry::half, 2.02),
       Tests::two_particles<3>(Symmetry::half, 2.5)},
      {"cut at x",
       Tests::three_particles<3>(2.02),
       Tests::three_particles<3>(2.5)},
      {"cut at y",
       Tests::three_particles<3>(2.02, 10., Cut::y_plane),
       Tests::three_particles<3>(2.5, 10., Cut::y_plane)}};

    unsigned int uncut = 0;
    for (const Case &c : cases)
      {
        const unsigned int coarse = iterations(c.wide, 16),
                           fine   = iterations(c.wide, 48),
                           narrow = iterations(c.narrow, 48);
        claims.at_most(c.name + ": few", fine, 50);
        claims.at_most(c.name + ": on finer elements", fine, 1.3 * coarse);
        claims.at_most(c.name + ": in a narrower gap", narrow, 1.3 * fine);
        if (uncut == 0)
          uncut = fine;
        else
          claims.at_most(c.name + ": as in the uncut box", fine, 1.1 * uncut);
      }
  });
}

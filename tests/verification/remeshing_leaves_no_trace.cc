// A pair held at the smallest gap in a fluid of high elasticity, on a rather
// coarse mesh: with a new mesh at a given instant and without one the
// velocities and the force in the contact are nearly the same, in the step with
// the new mesh and in those after it.

#include "new_meshes.h"

using namespace Catena;
using namespace Catena::Tests;



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const Trace trace =
      largest(traces_of_new_meshes(claims, 48, 2, 0.12, {1.08}, 4));
    claims.at_most("spin [gamma]", trace.spin, 1.2e-3);
    claims.at_most("velocity [a gamma]", trace.velocity, 1e-3);
    claims.at_most("force [F_S]", trace.force, 1.5e-3);
  });
}

// A pair held at the smallest gap in a fluid of high elasticity gets a new mesh
// at ten instants of its turning. In the step with the new mesh its spin and
// the force in the contact are those of the run without one, on M2 to 0.2 % of
// gamma and F_S, on M3 to 0.05 %.

#include "../verification/new_meshes.h"

using namespace Catena;
using namespace Catena::Tests;



std::vector<Trace>
traces(Claims            &claims,
       const unsigned int elements_on_equator,
       const unsigned int elements_across_gap)
{
  std::vector<double> strains;
  for (unsigned int i = 0; i < 10; ++i)
    strains.push_back(1.04 + 0.24 * i);
  return traces_of_new_meshes(
    claims, elements_on_equator, elements_across_gap, 0.08, strains, 1);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const auto on_m2 = traces(claims, 64, 2), on_m3 = traces(claims, 96, 3);
    claims.at_most("M2, spin [gamma]", largest(on_m2).spin, 2e-3);
    claims.at_most("M2, force [F_S]", largest(on_m2).force, 2e-3);
    claims.at_most("M3, spin [gamma]", largest(on_m3).spin, 5e-4);
    claims.at_most("M3, force [F_S]", largest(on_m3).force, 5e-4);
  });
}

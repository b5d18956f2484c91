// A pair held at the smallest gap in a fluid of high elasticity gets a new mesh
// at ten instants of its turning. In the step with the new mesh its velocities
// and the force in the contact are those of the run without one, on M2 to 0.2 %
// of gamma and F_S.

#include "../verification/new_meshes.h"

using namespace Catena;
using namespace Catena::Tests;



void
compare(Claims            &claims,
        const std::string &name,
        const unsigned int elements_on_equator,
        const unsigned int elements_across_gap,
        const double       bound)
{
  std::vector<double> strains;
  for (unsigned int i = 0; i < 10; ++i)
    strains.push_back(1.04 + 0.24 * i);
  const std::vector<Trace> traces = traces_of_new_meshes(
    elements_on_equator, elements_across_gap, 0.08, strains, 1);
  const Trace average = mean(traces), worst = largest(traces);
  print(name,
        ": mean spin ",
        average.spin,
        ", velocity ",
        average.velocity,
        ", force ",
        average.force);
  claims.at_most(name + ", spin [gamma]", worst.spin, bound);
  claims.at_most(name + ", force [F_S]", worst.force, bound);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    compare(claims, "M2", 64, 2, 2e-3);
    compare(claims, "M3", 96, 3, 5e-4);
  });
}

// Time steps end at the turns of the shear, at the strains of the fields and at
// the end, none of them a multiple of the step, and there are no short rests
// but where two of these are close.

#include <algorithm>
#include <cmath>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;
using namespace Catena::Tests;



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    SimulationParameters parameters = three_discs_parameters(0.5, 0.1);
    parameters.fluid.model          = FluidParameters::Model::newtonian;
    parameters.field_strains        = {0., 0.234, 0.45605, 0.678};
    parameters.reversal_strains     = {0.456};
    parameters.final_strain         = 0.91;
    Simulation<2> simulation(three_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();

    std::vector<double> reached;
    double              shortest = 1., longest = 0.;
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        const double dt = simulation.advance().dt;
        reached.push_back(simulation.strain());
        if (std::abs(simulation.strain() - 0.45605) > 1e-9)
          shortest = std::min(shortest, dt);
        longest = std::max(longest, dt);
      }
    for (const double due : {0.234, 0.456, 0.45605, 0.678, 0.91})
      claims.holds("a step ends at " + std::to_string(due),
                   std::any_of(reached.begin(),
                               reached.end(),
                               [&](const double strain) {
                                 return std::abs(strain - due) < 1e-12;
                               }));
    claims.at_least("the shortest step", shortest, 0.05);
    claims.at_most("the longest step", longest, 0.1);
  });
}

// Three discs in a Carreau fluid and in a Newtonian one: when the walls turn
// back at strain 0.8 the discs go back on their way, and at strain 1.6 they are
// where they were, with an error of second order in the time step.

#include <string>

#include "../tests.h"

#include "../print.h"
#include "three_discs.h"

using namespace Catena;
using namespace Catena::Tests;

/// Distance from the start at the end, after a look at the turning point.
double
way_left(Claims                      &claims,
         const std::string           &name,
         const FluidParameters::Model fluid,
         const double                 dt)
{
  SimulationParameters parameters       = three_discs_parameters(0.4, dt);
  parameters.fluid.model                = fluid;
  parameters.fluid.carreau.carreau_time = 10.;
  parameters.fluid.carreau.power_index  = 0.3;
  parameters.nonlinear_solver.tolerance = 1e-9;
  parameters.final_strain               = 1.6;
  parameters.reversal_strains           = {0.8};
  Simulation<2> simulation(three_discs(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  const auto start = state_of_discs(simulation);

  DiscState turn = start;
  while (simulation.strain() < parameters.final_strain - 1e-9)
    {
      simulation.advance();
      if (simulation.strain() < 0.8 + 1e-9)
        turn = state_of_discs(simulation);
    }
  const auto   end  = state_of_discs(simulation);
  const double left = distance(start.position, end.position);
  print(name,
        ", dt ",
        dt,
        ": way ",
        distance(start.position, turn.position),
        ", left ",
        left,
        ", velocity at first ",
        start.velocity[0],
        ' ',
        start.velocity[1],
        ", at last ",
        end.velocity[0],
        ' ',
        end.velocity[1]);
  claims.at_least(name + ": the discs go some way",
                  distance(start.position, turn.position),
                  0.15);
  claims.near(name + ": the velocity has changed its sign",
              end.velocity[0] / start.velocity[0],
              -1.,
              1e-2);
  return left;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    for (const auto &fluid : {std::make_pair(std::string("Newtonian"),
                                             FluidParameters::Model::newtonian),
                              std::make_pair(std::string("Carreau"),
                                             FluidParameters::Model::carreau)})
      {
        const double coarse =
          way_left(claims, fluid.first + ", dt 0.1", fluid.second, 0.1);
        const double fine =
          way_left(claims, fluid.first + ", dt 0.05", fluid.second, 0.05);
        claims.at_most(fluid.first + ": the discs are back", fine, 2e-3);
        claims.at_least(fluid.first + ": of second order in the time step",
                        std::log2(coarse / fine),
                        1.7);
      }
  });
}

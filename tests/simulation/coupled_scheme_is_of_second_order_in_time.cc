// Three discs in a Giesekus fluid on one mesh that moves with them, from rest
// through the start-up with fixed discs and the ramp of their holding force to
// a free motion: halving the time step divides what it changes by four.

#include <array>
#include <cmath>
#include <string>

#include "../tests.h"

#include "../print.h"
#include "three_discs.h"

using namespace Catena;
using namespace Catena::Tests;

/// The state at strain 2 on one mesh.
DiscState
simulate(Claims &claims, const double h, const double dt)
{
  SimulationParameters parameters = three_discs_parameters(h, dt);
  parameters.final_strain         = 2.;
  Simulation<2> simulation(three_discs(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  bool   remeshed = false;
  double gap = 1., quality = 1.;
  while (simulation.strain() < parameters.final_strain - 1e-9)
    {
      remeshed |= simulation.advance().remeshed;
      gap     = std::min(gap,
                     simulation.contact_set().smallest_gap(
                       simulation.current_state().now.configuration));
      quality = std::min(quality, simulation.mesh().quality());
    }
  const DiscState state = state_of_discs(simulation);
  print("element size ",
        h,
        ", dt ",
        dt,
        ": ",
        simulation.mesh().n_global_cells(),
        " elements, smallest gap ",
        gap,
        " diameters, smallest quality ",
        quality,
        ", position ",
        state.position[0],
        ' ',
        state.position[1],
        ", velocity ",
        state.velocity[0],
        ' ',
        state.velocity[1],
        ", spins ",
        state.spins[0],
        ' ',
        state.spins[1]);
  if (remeshed || gap < 0.1)
    claims.holds("one mesh and no contact", false);
  return state;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    constexpr double h = 0.2;
    // what halving the step changes: position, velocity, spins
    std::vector<std::array<double, 3>> changes;
    DiscState                          last = simulate(claims, h, 0.025);
    for (const double dt : {0.0125, 0.00625, 0.003125})
      {
        const DiscState state = simulate(claims, h, dt);
        changes.push_back({{distance(state.position, last.position),
                            distance(state.velocity, last.velocity),
                            distance(state.spins, last.spins)}});
        last = state;
      }
    const std::array<std::string, 3> quantities = {
      {"position", "velocity", "spins"}};
    for (unsigned int i = 0; i < quantities.size(); ++i)
      {
        const auto order = [&](const unsigned int n) {
          return std::log2(changes[n][i] / changes[n + 1][i]);
        };
        print(quantities[i], ": orders ", order(0), ", ", order(1));
        claims.at_least("order of the " + quantities[i], order(1), 1.8);
      }
  });
}

// Three discs in a Giesekus fluid on one mesh that moves with them, from rest
// through the start-up with fixed discs and the ramp of their holding force to
// a free motion: halving the time step divides what it changes by four, but for
// a part of first order that is an error of the mesh: the predicted stress has
// the rates of the points, the P1 stress follows them in the mean over
// elements, and the two differ by the time step times what vanishes with the
// square of the element size.

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



/**
 * What halving the time step changes.
 */
struct Changes
{
  std::string         name;
  std::vector<double> of_halving;

  /**
   * The part of first order of the first change: a change by halving is
   * A/4^i + B/2^i, of which the last two give B.
   */
  double
  first_order() const
  {
    const unsigned int n = of_halving.size();
    return std::ldexp(4. * of_halving[n - 1] - of_halving[n - 2], n - 2);
  }

  /// Order of the rest, from the first two changes.
  double
  order_of_rest() const
  {
    return std::log2((of_halving[0] - first_order()) /
                     (of_halving[1] - first_order() / 2.));
  }
};



std::vector<Changes>
changes(Claims &claims, const double h)
{
  std::vector<Changes>   result = {{"position", {}},
                                   {"velocity", {}},
                                   {"spins", {}}};
  std::vector<DiscState> states;
  for (const double dt : {0.1, 0.05, 0.025, 0.0125})
    {
      states.push_back(simulate(claims, h, dt));
      const unsigned int n = states.size();
      if (n == 1)
        continue;
      const DiscState &a = states[n - 2], &b = states[n - 1];
      result[0].of_halving.push_back(distance(a.position, b.position));
      result[1].of_halving.push_back(distance(a.velocity, b.velocity));
      result[2].of_halving.push_back(distance(a.spins, b.spins));
      if (n > 2)
        for (const Changes &c : result)
          print("  ",
                c.name,
                " changes by ",
                c.of_halving[n - 3],
                ", then ",
                c.of_halving[n - 2]);
    }
  return result;
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const auto coarse = changes(claims, 0.4);
    const auto fine   = changes(claims, 0.1);
    for (unsigned int i = 0; i < fine.size(); ++i)
      {
        const std::string &name = fine[i].name;
        claims.at_least(name + ", order 2 but for a part of first order",
                        fine[i].order_of_rest(),
                        1.9);
        claims.at_most(name + ", that part goes with the mesh",
                       fine[i].first_order() / coarse[i].first_order(),
                       1. / 3.);
      }
  });
}

// Three discs, the outer ones pressed on the middle one, in fluids with and
// without solvent: in the step onto a new mesh they turn and are held as in the
// step on the old one.

#include <string>
#include <utility>
#include <vector>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;

namespace
{
  struct Step
  {
    Tests::DiscState discs;
    double           force;
  };



  Step
  step(const double solvent_viscosity_ratio, const bool on_a_new_mesh)
  {
    auto parameters        = Tests::three_discs_parameters(0.35, 0.08);
    parameters.minimal_gap = 0.15;
    parameters.fluid.giesekus.solvent_viscosity_ratio = solvent_viscosity_ratio;
    parameters.fluid.giesekus.weissenberg_number      = 2.;
    Simulation<2> simulation(Tests::close_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();
    while (simulation.strain() < 1.)
      simulation.advance();
    if (on_a_new_mesh)
      simulation.request_remesh();
    simulation.advance();
    return {Tests::state_of_discs(simulation),
            simulation.current_state().now.flow.contact_forces.at(0)};
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const std::vector<std::pair<double, std::string>> fluids = {
      {0.5, "solvent"}, {0.1, "little solvent"}, {0., "no solvent"}};
    for (const auto &[beta, fluid] : fluids)
      {
        const Step without = step(beta, false), with = step(beta, true);
        claims.at_least("a force holds the gap: " + fluid, without.force, 0.5);
        claims.near("the force, " + fluid, with.force, without.force, 0.02);
        claims.at_most("velocities, " + fluid,
                       Tests::distance(with.discs.velocity,
                                       without.discs.velocity),
                       3e-4);
        claims.at_most("spins, " + fluid,
                       Tests::distance(with.discs.spins, without.discs.spins),
                       2e-3);
      }
  });
}

// Three discs in a Newtonian fluid come into contact while the shear presses
// them together, stay at exactly the smallest gap as long as it does, and part.

#include <limits>

#include "../tests.h"

#include "../print.h"
#include "three_discs.h"

int
main(int argc, char **argv)
{
  using namespace Catena;

  return Tests::run(argc, argv, [](auto &claims) {
    auto parameters         = Tests::three_discs_parameters(0.4, 0.08);
    parameters.fluid.model  = FluidParameters::Model::newtonian;
    parameters.minimal_gap  = 0.1;
    parameters.final_strain = 12.;
    // those of usual runs
    const SimulationParameters usual;
    parameters.remesh_quality        = usual.remesh_quality;
    parameters.remesh_gap            = usual.remesh_gap;
    parameters.flow_solver.tolerance = usual.flow_solver.tolerance;

    Simulation<2> simulation(Tests::three_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();

    double       narrowest = std::numeric_limits<double>::max(), drift = 0.;
    double       strongest = 0., weakest = 0., gap = 0.;
    unsigned int n_closed = 0, n_opened = 0;
    bool         was_held = false;
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        const auto  step = simulation.advance();
        const auto &now  = simulation.current_state().now;
        gap              = 0.5 * now.configuration.centres[1].norm() - 1. -
              parameters.minimal_gap;
        narrowest = std::min(narrowest, gap);
        if (was_held)
          drift = std::max(drift, std::abs(gap));
        for (const double force : now.flow.contact_forces)
          {
            strongest = std::max(strongest, force);
            weakest   = std::min(weakest, force);
          }
        const bool is_held = simulation.contact_set().n_held() > 0;
        n_closed += is_held && !was_held;
        n_opened += was_held && !is_held;
        was_held = is_held;
        Tests::print("strain ",
                     simulation.strain(),
                     ", gap ",
                     gap,
                     ", candidates ",
                     now.flow.contact_forces.size(),
                     ", force ",
                     now.flow.contact_forces.empty() ?
                       0. :
                       now.flow.contact_forces[0],
                     ", iterations ",
                     step.flow_iterations,
                     step.remeshed ? ", remeshed" : "");
      }
    claims.near("the discs come into contact once", n_closed, 1., 0.);
    claims.near("and part once", n_opened, 1., 0.);
    claims.at_least("the contact repels", strongest, 0.1);
    claims.at_least("it never attracts", weakest, 0.);
    claims.at_least("no gap is below the smallest", narrowest, -1e-12);
    claims.at_most("the held gap does not drift", drift, 1e-12);
    claims.at_least("the gap opens", gap, 0.02);
  });
}

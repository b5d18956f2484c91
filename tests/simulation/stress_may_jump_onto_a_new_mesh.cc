// A log-conformation that is far off its extrapolation at one vertex, however
// short the step, ends a run; but not in the step onto a new mesh, where a
// steep stress may be another one.

#include <catena/base/exceptions.h>

#include <string>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;

namespace
{
  /// What is said of a step whose log-conformation is changed by @p jump at the
  /// first vertex; that it fails if it is not taken as long as it is.
  std::string
  message(const double jump, const bool on_a_new_mesh)
  {
    Simulation<2> simulation(Tests::three_discs(),
                             Tests::three_discs_parameters(0.5, 0.08),
                             MPI_COMM_WORLD);
    simulation.initialize();
    while (simulation.strain() < 0.1)
      simulation.advance();

    simulation.inject_failures([&](const StepPart part, Level<2> &next) {
      if (part != StepPart::conformation)
        return;
      VectorType &component = next.log_conformation[0];
      component.local_element(0) += jump;
      component.update_ghost_values();
    });
    if (on_a_new_mesh)
      simulation.request_remesh();
    try
      {
        const StepReport step = simulation.advance();
        return step.dt < 0.079       ? "shorter" :
               step.troubles.empty() ? "" :
                                       step.troubles.front();
      }
    catch (const SolverError &)
      {
        return "fails";
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    claims.holds("a change of 0.5 is accepted", message(0.5, false).empty());
    claims.holds("one of 2 is not", message(2., false) == "fails");
    claims.holds("but it is on a new mesh, and is told",
                 message(2., true).find("jumps by 2") != std::string::npos);
    claims.holds("where one of 8 is not", message(8., true) == "fails");
  });
}

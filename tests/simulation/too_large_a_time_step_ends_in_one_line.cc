// The conformation relaxes by an explicit formula, stable up to a step of 4/3
// of the relaxation time times the smallest eigenvalue of c. A longer one makes
// it grow without bound: the run ends with a sentence that names the remedy.
// Half of that is stable.

#include <catena/base/exceptions.h>
#include <catena/scene/confined_cylinder.h>
#include <catena/simulation/simulation.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

/// What ended a run of 40 relaxation times, empty if nothing did.
std::string
failure(const double time_step)
{
  ConfinedCylinderParameters channel;
  channel.length = 10.;
  SimulationParameters parameters;
  parameters.fluid.giesekus.weissenberg_number      = 0.1;
  parameters.fluid.giesekus.mobility_parameter      = 0.;
  parameters.fluid.giesekus.solvent_viscosity_ratio = 0.59;
  parameters.mesh.elements_on_equator               = 16;
  parameters.mesh.maximal_size                      = 1.;
  parameters.time_step                              = time_step;
  parameters.final_strain                           = 4.;

  Simulation<2> simulation(channel.scene(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  try
    {
      while (simulation.strain() < parameters.final_strain - 1e-9)
        simulation.advance();
    }
  catch (const SolverError &error)
    {
      return error.what();
    }
  return "";
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const std::string text = failure(0.2);
    std::cout << text << std::endl;
    claims.holds("a step of two relaxation times ends in one line",
                 !text.empty() && text.find('\n') == std::string::npos);
    claims.holds("that names the remedy",
                 text.find("smaller time step") != std::string::npos);
    claims.holds("half of the bound is stable", failure(0.035).empty());
  });
}

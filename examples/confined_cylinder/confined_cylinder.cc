/**
 * The drag on a cylinder in a channel, past which a Newtonian, Carreau or
 * viscoelastic fluid is driven by pressure, against the flow rate.
 *
 * Sample runs:
 *   confined_cylinder parameter_files/confined_cylinder/quick.prm
 *   confined_cylinder parameter_files/verification/confined_cylinder.prm
 */

#include <catena/base/program_options.h>
#include <catena/scene/confined_cylinder.h>
#include <catena/simulation/steady_sweep.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  ConfinedCylinderParameters scene;
  SimulationParameters       simulation;
  SteadySweepParameters      sweep;

  Program program;
  program.name        = "confined_cylinder";
  program.description = "The drag on a cylinder in a channel of Newtonian, "
                        "Carreau or viscoelastic fluid.";
  program.declare     = [&](dealii::ParameterHandler &prm) {
    scene.declare(prm);
    simulation.declare(prm);
    sweep.declare(prm);
  };
  program.check = [&]() {
    scene.check();
    simulation.check();
    simulation.check_scene(scene.scene());
    sweep.check(simulation);
  };
  program.run = [&](const ProgramOptions &options) {
    const std::string directory =
      options.results_directory(simulation.output_directory);
    prepare_output_directory(directory, options.overwrite, MPI_COMM_WORLD);
    steady_sweep(scene.scene(),
                 simulation,
                 sweep,
                 drag_coefficient<2>(),
                 directory,
                 MPI_COMM_WORLD);
  };
  return run_program(argc, argv, program);
}

/**
 * The rotation rate of a lone sphere in sheared fluid, Newtonian, Carreau or
 * viscoelastic, against the shear rate.
 *
 * Sample runs:
 *   one_particle parameter_files/one_particle/quick.prm
 *   one_particle parameter_files/one_particle/oldroyd_b.prm
 */

#include <catena/base/program_options.h>
#include <catena/scene/one_particle.h>
#include <catena/simulation/steady_sweep.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  OneParticleParameters scene;
  SimulationParameters  simulation;
  SteadySweepParameters sweep;

  Program program;
  program.name        = "one_particle";
  program.description = "The rotation rate of a lone sphere in sheared "
                        "Newtonian, Carreau or viscoelastic fluid.";
  program.declare     = [&](dealii::ParameterHandler &prm) {
    scene.declare(prm);
    simulation.declare(prm);
    sweep.declare(prm);
  };
  program.check = [&]() {
    scene.check();
    simulation.check();
    simulation.check_scene(scene.scene<3>());
    sweep.check(simulation);
  };
  program.run = [&](const ProgramOptions &options) {
    const std::string directory =
      options.results_directory(simulation.output_directory);
    prepare_output_directory(directory, options.overwrite, MPI_COMM_WORLD);
    steady_sweep(scene.scene<3>(),
                 simulation,
                 sweep,
                 rotation_rate<3>(),
                 directory,
                 MPI_COMM_WORLD);
  };
  return run_program(argc, argv, program);
}

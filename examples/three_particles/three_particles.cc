/**
 * Three particles in sheared Newtonian or viscoelastic fluid: do they align
 * into a string or pass each other?
 *
 * Sample runs:
 *   three_particles parameter_files/three_particles/quick.prm
 *   three_particles parameter_files/three_particles/aligning.prm
 *   mpirun -np 2 three_particles parameter_files/three_particles/passing.prm
 */

#include <catena/base/program_options.h>
#include <catena/scene/three_particles.h>
#include <catena/simulation/run.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  ThreeParticlesParameters scene;
  SimulationParameters     simulation;

  Program program;
  program.name = "three_particles";
  program.description =
    "Three particles in a line in sheared Newtonian or viscoelastic fluid.";
  program.declare = [&](dealii::ParameterHandler &prm) {
    scene.declare(prm);
    simulation.declare(prm);
  };
  program.check = [&]() {
    scene.check();
    simulation.check();
  };
  program.run = [&](const ProgramOptions &options) {
    run_simulation(scene.scene<3>(),
                   simulation,
                   options.output_directory.empty() ?
                     simulation.output_directory :
                     options.output_directory,
                   options.overwrite,
                   MPI_COMM_WORLD);
  };
  return run_program(argc, argv, program);
}

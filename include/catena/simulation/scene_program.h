#ifndef catena_simulation_scene_program_h
#define catena_simulation_scene_program_h

#include <catena/base/program_options.h>
#include <catena/simulation/run.h>

#include <string>

namespace Catena
{
  /**
   * The main() of a program that runs one scene in three dimensions.
   *
   * @param scene its parameters, an object with `declare(prm)`, `check()` and
   * `scene<3>()`
   * @return the exit code of the program
   */
  template <typename SceneParameters>
  int
  run_scene_program(int                argc,
                    char             **argv,
                    const std::string &name,
                    const std::string &description,
                    SceneParameters    scene)
  {
    SimulationParameters simulation;

    Program program;
    program.name        = name;
    program.description = description;
    program.declare     = [&](dealii::ParameterHandler &prm) {
      scene.declare(prm);
      simulation.declare(prm);
    };
    program.can_resume = true;
    program.check      = [&]() {
      scene.check();
      simulation.check();
      simulation.check_scene(scene.template scene<3>());
    };
    program.run = [&](const ProgramOptions &options) {
      run_simulation(scene.template scene<3>(),
                     simulation,
                     {options.results_directory(simulation.output_directory),
                      options.overwrite,
                      options.resume},
                     MPI_COMM_WORLD);
    };
    return run_program(argc, argv, program);
  }
} // namespace Catena

#endif

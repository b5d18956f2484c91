#ifndef catena_simulation_sweep_program_h
#define catena_simulation_sweep_program_h

#include <catena/base/program_options.h>
#include <catena/simulation/steady_sweep.h>

#include <string>

namespace Catena
{
  /**
   * The main() of a program that runs one scene to its steady state at a number
   * of rates.
   *
   * @param scene its parameters, an object with `declare(prm)`, `check()` and
   * `scene<dim>()`
   * @return the exit code of the program
   */
  template <int dim, typename SceneParameters>
  int
  run_sweep_program(int                        argc,
                    char                     **argv,
                    const std::string         &name,
                    const std::string         &description,
                    SceneParameters            scene,
                    const SteadyQuantity<dim> &quantity)
  {
    SimulationParameters  simulation;
    SteadySweepParameters sweep;

    Program program;
    program.name        = name;
    program.description = description;
    program.declare     = [&](dealii::ParameterHandler &prm) {
      scene.declare(prm);
      simulation.declare(prm);
      sweep.declare(prm);
    };
    program.can_resume = true;
    program.check      = [&]() {
      scene.check();
      simulation.check();
      simulation.check_scene(scene.template scene<dim>());
      sweep.check(simulation);
    };
    program.run = [&](const ProgramOptions &options) {
      steady_sweep(scene.template scene<dim>(),
                   simulation,
                   sweep,
                   quantity,
                   {options.results_directory(simulation.output_directory),
                    options.overwrite,
                    options.resume},
                   MPI_COMM_WORLD);
    };
    return run_program(argc, argv, program);
  }
} // namespace Catena

#endif

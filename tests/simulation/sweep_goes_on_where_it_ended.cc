// A sweep that fails goes on with the rate that was not finished: its tables
// are those of a sweep that was left alone. Rates can be added, another mesh is
// refused and changes nothing. One that replaces another takes nothing from it.

#include <catena/scene/confined_cylinder.h>
#include <catena/simulation/steady_sweep.h>

#include <filesystem>
#include <sstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  const std::string whole = "whole", broken = "broken";



  RunOptions
  anew(const std::string &directory)
  {
    return {directory, false, false};
  }



  RunOptions
  resumed(const std::string &directory)
  {
    return {directory, false, true};
  }



  SimulationParameters
  coarse()
  {
    SimulationParameters parameters;
    parameters.fluid.giesekus.mobility_parameter      = 0.;
    parameters.fluid.giesekus.solvent_viscosity_ratio = 0.59;
    parameters.mesh.elements_on_equator               = 16;
    parameters.mesh.growth                            = 0.5;
    parameters.mesh.maximal_size                      = 2.;
    parameters.step_control.time_step                 = 0.1;
    parameters.final_strain                           = 6.;
    parameters.checkpoint.strain_interval             = 0.5;
    return parameters;
  }



  /// @return what the sweep is refused or ends with; empty if all is well
  std::string
  sweep(const RunOptions           &options,
        const std::vector<double>  &rates,
        const SteadyQuantity<2>    &quantity,
        const SimulationParameters &parameters = coarse())
  {
    ConfinedCylinderParameters scene;
    scene.length = 10.;
    SteadySweepParameters sweep;
    sweep.rates     = rates;
    sweep.tolerance = 1e-2;
    std::ostringstream dark;
    auto *const        screen = std::cout.rdbuf(dark.rdbuf());
    std::string        message;
    try
      {
        steady_sweep(
          scene.scene(), parameters, sweep, quantity, options, MPI_COMM_WORLD);
      }
    catch (const Error &error)
      {
        message = error.what();
      }
    std::cout.rdbuf(screen);
    std::cout << message << std::endl;
    return message;
  }



  /// Are two tables the same but for the seconds?
  bool
  same(const std::string &name)
  {
    const auto path = std::filesystem::current_path().string() + "/";
    const auto a    = Tests::read_table(path + whole + "/" + name),
               b    = Tests::read_table(path + broken + "/" + name);
    bool good       = a.n_rows == b.n_rows && a.n_rows > 0;
    for (const auto &[column, cells] : a.text)
      good = good && (column.find("seconds") != std::string::npos ||
                      b.text.at(column) == cells);
    return good;
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    for (const std::string &folder : {whole, broken})
      std::filesystem::remove_all(folder);

    const auto drag    = drag_coefficient<2>();
    auto       failing = drag;
    failing.value      = [&](const Simulation<2> &simulation) {
      if (simulation.strain() > 1.2)
        throw SolverError("The sweep was made to fail.");
      return drag.value(simulation);
    };

    claims.holds("a sweep ends well",
                 sweep(anew(whole), {0., 0.2}, drag) == "");
    claims.holds("no checkpoint is said to be none",
                 sweep(resumed(broken), {0., 0.2}, drag)
                     .find("without --resume") != std::string::npos);
    const std::string message = sweep(anew(broken), {0., 0.2}, failing);
    claims.holds("one that fails names strain and checkpoint",
                 message.find("At strain 1.275") != std::string::npos &&
                   message.find("checkpoint is that of strain 1.075:") !=
                     std::string::npos);
    auto other                     = coarse();
    other.mesh.elements_on_equator = 20;
    claims.holds("another mesh is refused by name",
                 sweep(resumed(broken), {0., 0.2}, drag, other)
                     .find("'Mesh / Elements on equator' = 20") !=
                   std::string::npos);
    claims.holds("and leaves the table",
                 Tests::read_table(std::filesystem::current_path().string() +
                                   "/" + broken + "/drag.csv")
                     .n_rows == 1);
    claims.holds("goes on when it is mended",
                 sweep(resumed(broken), {0., 0.2}, drag) == "");
    for (const std::string name :
         {"drag.csv", "rate_0/trajectory.csv", "rate_0.2/trajectory.csv"})
      claims.holds(name + " is the same", same(name));

    claims.holds("a rate is added",
                 sweep(resumed(whole), {0., 0.1, 0.2}, drag) == "" &&
                   sweep(resumed(broken), {0., 0.1, 0.2}, drag) == "");
    claims.holds("to the table", same("drag.csv"));

    sweep({broken, true, false}, {0.3}, failing);
    for (const std::string rate : {"0", "0.1", "0.2"})
      claims.holds("nothing is left of rate " + rate + " after another sweep",
                   !std::filesystem::exists(broken + "/rate_" + rate +
                                            "/checkpoint_0"));
  });
}

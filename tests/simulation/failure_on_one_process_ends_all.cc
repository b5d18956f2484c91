// What goes wrong on one of two processes, of which the other knows nothing,
// ends both with one line that names the process, the cause and the checkpoint.
// The run goes on from there.

#include <catena/base/program_options.h>
#include <catena/simulation/run.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;

namespace
{
  /// The program that is run on two processes.
  int
  child(const std::string &what)
  {
    auto parameters         = Tests::three_discs_parameters(0.5, 0.1);
    parameters.fluid.model  = FluidParameters::Model::newtonian;
    parameters.final_strain = 0.6;
    parameters.checkpoint.strain_interval = 0.2;

    Program program;
    program.name       = "child";
    program.can_resume = true;
    program.declare    = [](dealii::ParameterHandler &) {};
    program.run        = [&](const ProgramOptions &options) {
      run_simulation<2>(
        Tests::three_discs(),
        parameters,
        {"run", false, options.resume},
        MPI_COMM_WORLD,
        nullptr,
        [&](Simulation<2> &simulation) {
          simulation.inject_failures([&](const StepPart, Level<2> &level) {
            if (level.time < 0.35 ||
                dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 1)
              return;
            if (what == "error")
              throw Error("One process was made to fail.");
            if (what == "memory")
              throw std::bad_alloc();
          });
        });
    };
    std::ofstream("empty.prm");
    std::vector<std::string> arguments = {"child", "empty.prm"};
    if (what == "nothing")
      arguments.push_back("--resume");
    std::vector<char *> argv;
    for (std::string &argument : arguments)
      argv.push_back(argument.data());
    return run_program(argv.size(), argv.data(), program);
  }



  /// Run it. @return its exit code
  int
  run(const std::string &self, const std::string &what)
  {
    if (what != "nothing")
      std::filesystem::remove_all("run");
    const std::string command = "mpirun -np 2 '" + self + "' " + what + " > " +
                                what + ".out 2> " + what + ".err";
    return std::system(command.c_str());
  }



  /// What Catena has said about the failure; empty if that is not one line.
  std::string
  message(const std::string &what)
  {
    std::ifstream file(what + ".err");
    std::string   found;
    for (std::string line; std::getline(file, line);)
      if (line.compare(0, 5, "Error") == 0)
        {
          if (!found.empty())
            return "";
          found = line;
        }
    std::cout << found << std::endl;
    return found;
  }
} // namespace



int
main(int argc, char **argv)
{
  if (argc > 1)
    return child(argv[1]);

  // MPI is started in the children only, before it is here
  const std::string self  = std::filesystem::canonical(argv[0]).string();
  const bool        error = run(self, "error") != 0,
             resumed      = run(self, "nothing") == 0,
             memory       = run(self, "memory") != 0;
  return Tests::run(argc, argv, [&](Tests::Claims &claims) {
    const auto says = [](const std::string &what, const std::string &cause) {
      const std::string text = message(what);
      return text.find("Error on process 1: At strain 0.3: " + cause) == 0 &&
             text.find("checkpoint is that of strain 0.2:") !=
               std::string::npos;
    };
    claims.holds("an error on one process ends both", error);
    claims.holds("cause and checkpoint are named",
                 says("error", "One process was made to fail."));
    claims.holds("the run goes on from there", resumed);
    claims.holds("no memory on one process ends both", memory);
    claims.holds("its cause and checkpoint are named",
                 says("memory", "out of memory"));
  });
}

// A program does what its command line asks for; what goes wrong becomes one
// line on the error stream and an exit code.

#include <catena/base/exceptions.h>
#include <catena/base/program_options.h>

#include <deal.II/base/exceptions.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  const std::string file_name = "program_ends.prm";

  /// Claims are recorded after the last child, since MPI starts only once.
  using Verdicts = std::vector<std::pair<std::string, bool>>;

  struct Outcome
  {
    int         exit_code;
    std::string output;
    std::string error;
  };



  std::string
  content(const std::string &name)
  {
    std::ifstream     file(name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }



  Program
  example()
  {
    static double size = 1.;

    Program program;
    program.name        = "example";
    program.description = "Does nothing.";
    program.declare     = [](dealii::ParameterHandler &prm) {
      prm.add_parameter("Size", size, "A size in units of a");
    };
    program.check = []() { require(size > 0., "Size", size, "must be > 0"); };
    program.run   = [](const ProgramOptions &options) {
      if (size == 2.)
        AssertThrow(false, dealii::ExcMessage("two\n  lines"));
      if (size == 3.)
        throw std::string("gmsh does\nthis");
      if (size == 4.)
        throw SolverError("did not converge");
      if (size == 5.)
        throw Interrupted(15, "Stopped by SIGTERM");
      if (size == 6.)
        throw CheckpointError("The checkpoint is damaged");
      std::cout << "ran into '" << options.output_directory << "'"
                << (options.overwrite ? " again" : "") << std::endl;
    };
    return program;
  }



  /**
   * Run the example in a process of its own.
   */
  Outcome
  run(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), "example");
    std::vector<char *> argv;
    for (std::string &argument : arguments)
      argv.push_back(&argument[0]);
    argv.push_back(nullptr);

    const pid_t child = fork();
    if (child == 0)
      {
        if (std::freopen("program_ends.out", "w", stdout) == nullptr ||
            std::freopen("program_ends.err", "w", stderr) == nullptr)
          _exit(99);
        const int code = run_program(argv.size() - 1, argv.data(), example());
        std::fflush(nullptr);
        _exit(code);
      }

    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            content("program_ends.out"),
            content("program_ends.err")};
  }



  bool
  has(const std::string &text, const std::string &word)
  {
    return text.find(word) != std::string::npos;
  }



  /**
   * Claim that with these arguments the program fails with this code and one
   * line.
   */
  void
  fails(Verdicts                       &verdicts,
        const std::string              &name,
        const std::vector<std::string> &arguments,
        const int                       exit_code,
        const std::string              &word)
  {
    const Outcome outcome = run(arguments);
    const bool one_line = outcome.error.find('\n') + 1 == outcome.error.size();
    const bool good     = outcome.exit_code == exit_code && one_line &&
                      outcome.output.empty() && has(outcome.error, word);
    verdicts.emplace_back(name + (good ? "" : ": " + outcome.error), good);
  }



  std::vector<std::string>
  file_with(const std::string &size)
  {
    std::ofstream(file_name) << "set Size = " << size << std::endl;
    return {file_name};
  }
} // namespace



int
main(int argc, char **argv)
{
  Verdicts verdicts;

  Outcome outcome = run({});
  verdicts.emplace_back("no argument: usage",
                        outcome.exit_code == 0 &&
                          has(outcome.output, "Usage:"));
  outcome = run({"--help"});
  verdicts.emplace_back("--help: usage",
                        outcome.exit_code == 0 &&
                          has(outcome.output, "Usage:"));

  outcome = run({"--template"});
  verdicts.emplace_back("--template: name and explanation",
                        outcome.exit_code == 0 &&
                          has(outcome.output, "set Size") &&
                          has(outcome.output, "# A size in units of a"));

  std::ofstream(file_name) << outcome.output;
  outcome = run({"--validate", file_name});
  verdicts.emplace_back("the template is valid",
                        outcome.exit_code == 0 &&
                          has(outcome.output, "valid") &&
                          outcome.error.empty());

  outcome = run({file_name, "--output", "somewhere", "--overwrite"});
  verdicts.emplace_back("run with options",
                        outcome.exit_code == 0 &&
                          outcome.output == "ran into 'somewhere' again\n");

  fails(verdicts, "unknown option", {"--tempalte"}, 2, "'--tempalte'");
  fails(verdicts, "no directory", {file_name, "--output"}, 2, "--output");
  fails(verdicts, "missing file", {"nowhere.prm"}, 2, "'nowhere.prm'");
  fails(verdicts, "bad value", file_with("large"), 2, "'Size' = large");
  fails(verdicts, "value out of range", file_with("-1"), 2, "'Size' = -1");
  fails(verdicts, "exception of deal.II", file_with("2"), 1, "two lines (line");
  fails(verdicts, "exception of gmsh", file_with("3"), 1, "gmsh does this");
  fails(verdicts, "exception of Catena", file_with("4"), 1, "not converge");
  fails(verdicts, "end by a signal", file_with("5"), 143, "Stopped by");
  fails(verdicts, "bad checkpoint", file_with("6"), 2, "is damaged");
  fails(verdicts, "--resume without", {file_name, "--resume"}, 2, "--resume");

  for (const char *name : {"prm", "out", "err"})
    std::remove((std::string("program_ends.") + name).c_str());

  return Tests::run(argc, argv, [&](Tests::Claims &claims) {
    for (const auto &[claim, verdict] : verdicts)
      claims.holds(claim, verdict);
  });
}

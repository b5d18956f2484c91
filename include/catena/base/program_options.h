#ifndef catena_base_program_options_h
#define catena_base_program_options_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>

namespace Catena
{
  /**
   * The command line of a program.
   */
  struct ProgramOptions
  {
    enum class Action
    {
      /// Print how to use the program.
      help,
      /// Write a parameter file with all parameters, explained.
      print_template,
      /// Check a parameter file and do nothing else.
      validate,
      /// Run with a parameter file.
      run
    };

    Action action = Action::help;

    /// The parameter file to run or to validate.
    std::string parameter_file;

    /// Directory for the results; if empty, the one of the parameter file.
    std::string output_directory;

    /// Results of an earlier run may be replaced.
    bool overwrite = false;

    /// Go on from the last checkpoint of an earlier run.
    bool resume = false;

    /// Where the results go, @p in_file being what the parameter file says.
    const std::string &
    results_directory(const std::string &in_file) const
    {
      return output_directory.empty() ? in_file : output_directory;
    }

    /**
     * Read the command line
     * `[FILE.prm] [--template] [--validate FILE.prm] [--output DIR]
     * [--overwrite | --resume] [--help]`.
     *
     * @throws InputError for an option that is unknown, incomplete or does not
     *   go with another.
     */
    static ProgramOptions
    parse(const int argc, const char *const *argv);
  };

  /**
   * What a program is made of; run_program() does the rest.
   */
  struct Program
  {
    std::string name;

    /// One sentence.
    std::string description;

    /// Does it write checkpoints, so that a run can go on from there?
    bool can_resume = false;

    /// Declare all parameters.
    std::function<void(dealii::ParameterHandler &)> declare;

    /// Check the parameters after a file was read; throws InputError.
    std::function<void()> check;

    std::function<void(const ProgramOptions &)> run;
  };

  /**
   * The main() of a program: starts and ends MPI, does what the command line
   * asks for and turns whatever goes wrong into one line on the standard error
   * stream.
   *
   * @return The exit code: 0 if all went well, 2 if the command line, the
   *   parameter file, a parameter or a checkpoint was refused, 1 if the run
   *   failed, 128 and the number of the signal if one has ended it.
   */
  int
  run_program(int argc, char **argv, const Program &program);

  /**
   * Make @p directory ready for the results of a run: create it with its
   * parents, see that files can be written. Collective.
   *
   * @throws InputError on all processes if it cannot be made or written, or
   *   if it holds files and @p overwrite is not set. Nothing is ever deleted.
   */
  void
  prepare_output_directory(const std::string &directory,
                           const bool         overwrite,
                           const MPI_Comm     communicator);
} // namespace Catena

#endif

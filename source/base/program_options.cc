#include <catena/base/all_arrive.h>
#include <catena/base/error_text.h>
#include <catena/base/exceptions.h>
#include <catena/base/parameter_file.h>
#include <catena/base/program_options.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr int exit_failed  = 1;
    constexpr int exit_refused = 2;
    constexpr int exit_signal  = 128;



    std::string
    usage(const Program &program)
    {
      return program.name + ": " + program.description + "\n\n" +
             "Usage:\n"
             "  " +
             program.name + " FILE.prm [--output DIR] [--overwrite" +
             (program.can_resume ? " | --resume" : "") +
             "]\n"
             "      run with the parameters of FILE.prm\n"
             "  " +
             program.name +
             " --template\n"
             "      write a parameter file with all parameters, explained\n"
             "  " +
             program.name +
             " --validate FILE.prm\n"
             "      check a parameter file and do nothing else\n\n"
             "Options:\n"
             "  --output DIR   write results to DIR, not to the directory the "
             "file names\n"
             "  --overwrite    allow a directory that holds results already\n" +
             (program.can_resume ?
                "  --resume       go on from the last checkpoint in the "
                "directory\n" :
                "") +
             "  --help         print this text\n";
    }



    void
    execute(const Program &program, const ProgramOptions &options)
    {
      const bool is_writer =
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

      if (options.action == ProgramOptions::Action::help)
        {
          if (is_writer)
            std::cout << usage(program);
          return;
        }

      require(!options.resume || program.can_resume,
              "command line",
              "--resume",
              "this program writes no checkpoints, start it without");

      ParameterHandler prm;
      program.declare(prm);

      if (options.action == ProgramOptions::Action::print_template)
        {
          if (is_writer)
            prm.print_parameters(std::cout,
                                 ParameterHandler::PRM |
                                   ParameterHandler::KeepDeclarationOrder);
          return;
        }

      read_parameters(prm, options.parameter_file);
      if (program.check)
        program.check();

      if (options.action == ProgramOptions::Action::run)
        program.run(options);
      else if (is_writer)
        std::cout << options.parameter_file << ": valid" << std::endl;
    }



    /**
     * Print @p message once, and end the other processes if they do not know.
     */
    int
    fail(const std::string &message, const int exit_code)
    {
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      std::cout << std::flush;

      const bool  together = all_arrive(MPI_COMM_WORLD);
      std::string line;
      if (rank == 0)
        line = "Error: " + message + '\n';
      else if (!together)
        line =
          "Error on process " + std::to_string(rank) + ": " + message + '\n';
      // at once, lest what mpirun says come in between
      std::cerr << line << std::flush;

      if (!together)
        MPI_Abort(MPI_COMM_WORLD, exit_code);
      return exit_code;
    }



    /**
     * What is wrong with @p directory as a place for results; empty if
     * nothing is.
     */
    std::string
    refusal(const std::string &directory, const bool overwrite)
    {
      namespace fs = std::filesystem;

      std::error_code error;
      fs::create_directories(directory, error);
      if (error || !fs::is_directory(directory))
        return "cannot be made (" +
               (error ? error.message() : std::string("a file")) +
               "): give another with --output DIR";

      const bool is_empty = fs::is_empty(directory, error);
      if (error)
        return "cannot be read (" + error.message() +
               "): give another with --output DIR";
      if (!is_empty && !overwrite)
        return "holds files already: give another with --output DIR or "
               "replace them with --overwrite";

      const fs::path probe = fs::path(directory) / ".catena_probe";
      std::ofstream  file(probe);
      file << "probe\n" << std::flush;
      const bool is_writable = file.good();
      file.close();
      fs::remove(probe, error);
      return is_writable ? "" :
                           "cannot be written: check its permissions and the "
                           "space on the disk";
    }
  } // namespace



  ProgramOptions
  ProgramOptions::parse(const int argc, const char *const *argv)
  {
    ProgramOptions options;
    const auto     choose = [&options](const Action       action,
                                   const std::string &argument) {
      require(options.action == Action::help,
              "command line",
              argument,
              "use one parameter file, --template or --validate at a time");
      options.action = action;
    };

    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if (argument == "--help" || argument == "-h")
          return ProgramOptions();

        if (argument == "--template")
          choose(Action::print_template, argument);
        else if (argument == "--overwrite")
          options.overwrite = true;
        else if (argument == "--resume")
          options.resume = true;
        else if (argument == "--validate" || argument == "--output")
          {
            const std::string value = i + 1 < argc ? argv[++i] : "";
            require(!value.empty() && value[0] != '-',
                    argument,
                    "'" + value + "'",
                    argument == "--output" ? "name a directory" :
                                             "name a parameter file");
            if (argument == "--validate")
              choose(Action::validate, argument);
            (argument == "--output" ? options.output_directory :
                                      options.parameter_file) = value;
          }
        else
          {
            require(!argument.empty() && argument[0] != '-',
                    "command line",
                    "'" + argument + "'",
                    "no such option, --help lists them");
            choose(Action::run, argument);
            options.parameter_file = argument;
          }
      }

    require(options.action != Action::help || argc <= 1,
            "command line",
            argc > 1 ? argv[1] : "",
            "name a parameter file as well");
    require(!(options.resume && options.overwrite),
            "command line",
            "--resume",
            "goes on with the results that are there, leave out --overwrite");
    return options;
  }



  int
  run_program(int argc, char **argv, const Program &program)
  {
    // The options are ours alone: other libraries would take --help and the
    // like for their own.
    int                              no_options = std::min(argc, 1);
    Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);

    try
      {
        execute(program, ProgramOptions::parse(argc, argv));
        return 0;
      }
    catch (const Interrupted &end)
      {
        std::cout << std::flush;
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cerr << end.what() << std::endl;
        return exit_signal + end.signal;
      }
    catch (const InputError &)
      {
        return fail(present_error_text(), exit_refused);
      }
    catch (const CheckpointError &)
      {
        return fail(present_error_text(), exit_refused);
      }
    catch (const ParameterFileError &)
      {
        return fail(present_error_text(), exit_refused);
      }
    catch (...)
      {
        return fail(present_error_text(), exit_failed);
      }
  }



  void
  prepare_output_directory(const std::string &directory,
                           const bool         overwrite,
                           const MPI_Comm     communicator)
  {
    std::string message;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      message = refusal(directory, overwrite);
    message = Utilities::MPI::broadcast(communicator, message, 0);
    require(message.empty(), "output directory", directory, message);
  }

} // namespace Catena

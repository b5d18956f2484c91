#include <catena/base/all_arrive.h>
#include <catena/base/error_text.h>
#include <catena/base/program_options.h>
#include <catena/output/progress.h>
#include <catena/simulation/checkpoint.h>
#include <catena/simulation/checkpoint_clock.h>
#include <catena/simulation/field_schedule.h>
#include <catena/simulation/health_watch.h>
#include <catena/simulation/run.h>
#include <catena/simulation/run_identity.h>
#include <catena/simulation/signals.h>
#include <catena/simulation/trajectory.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * A simulation with all that records it.
     */
    template <int dim>
    class Run
    {
    public:
      Run(const Scene<dim>           &scene,
          const SimulationParameters &parameters,
          const std::string          &directory,
          const MPI_Comm              communicator,
          Ending<dim>                *ending)
        : simulation(scene, parameters, communicator)
        , identity(scene, parameters)
        , parameters(parameters)
        , directory(directory)
        , communicator(communicator)
        , has_line(scene.line)
        , checkpoint(directory, communicator)
        , clock(parameters.checkpoint, communicator)
        , ending(ending)
      {}

      Simulation<dim> simulation;

      void
      start();

      void
      resume();

      void
      go_on();

      /// @p message with where it happened, and how to go on.
      std::string
      in_context(const std::string &message) const;

      void
      report_failure();

    private:
      const RunIdentity          identity;
      const SimulationParameters parameters;
      const std::string          directory;
      const MPI_Comm             communicator;
      const bool                 has_line;

      std::unique_ptr<Trajectory<dim>>    trajectory;
      std::unique_ptr<FieldSchedule<dim>> fields;
      std::unique_ptr<Progress>           progress;
      HealthWatch                         health;
      Checkpoint                          checkpoint;
      CheckpointClock                     clock;
      Ending<dim> *const                  ending;

      std::string
      table_path() const
      {
        return directory + "/trajectory.csv";
      }

      void
      begin_progress();

      void
      load(Archive &archive);

      void
      record(const StepReport &step);

      void
      show(const StepReport &step);

      void
      write_checkpoint();

      void
      answer(const Signals &signals);

      void
      end_if_asked(const Signals::Request &request) const;

      bool
      is_finished(const StepReport &step) const;
    };



    template <int dim>
    void
    Run<dim>::start()
    {
      simulation.initialize();
      trajectory = std::make_unique<Trajectory<dim>>(table_path(),
                                                     simulation,
                                                     communicator);
      fields     = std::make_unique<FieldSchedule<dim>>(parameters,
                                                    directory,
                                                    communicator);
      begin_progress();
      record(StepReport());
      if (parameters.checkpoint.enabled)
        write_checkpoint();
    }



    template <int dim>
    void
    Run<dim>::begin_progress()
    {
      progress = std::make_unique<Progress>(simulation.strain(),
                                            parameters.final_strain,
                                            communicator);
    }



    template <int dim>
    void
    Run<dim>::resume()
    {
      Archive archive(checkpoint.read());
      try
        {
          load(archive);
        }
      catch (const CheckpointError &error)
        {
          throw CheckpointError("The checkpoint in '" + directory +
                                "' cannot be used: " + error.what());
        }
      clock.restart(simulation.strain());
      simulation.report().count("resumed runs");
      begin_progress();
      std::ostringstream text;
      text << "Going on from strain " << simulation.strain();
      progress->message(text.str());
    }



    template <int dim>
    void
    Run<dim>::load(Archive &archive)
    {
      RunIdentity of_checkpoint;
      archive(of_checkpoint);
      identity.check_continues(of_checkpoint);
      simulation.archive(archive);
      TrajectoryTable::Position position;
      archive(position, health);
      if (ending != nullptr)
        ending->archive(archive);
      simulation.report().archive(archive);
      trajectory = std::make_unique<Trajectory<dim>>(table_path(),
                                                     simulation,
                                                     communicator,
                                                     position);
      fields     = std::make_unique<FieldSchedule<dim>>(parameters,
                                                    directory,
                                                    communicator);
      fields->archive(archive, simulation.strain());
      archive.finish();
    }



    template <int dim>
    void
    Run<dim>::write_checkpoint()
    {
      const auto                timer = simulation.report().time("checkpoints");
      TrajectoryTable::Position position = trajectory->sync();
      RunIdentity               mine     = identity;
      simulation.report().count("checkpoints");
      Archive archive;
      archive(mine);
      simulation.archive(archive);
      archive(position, health);
      if (ending != nullptr)
        ending->archive(archive);
      simulation.report().archive(archive);
      fields->archive(archive, simulation.strain());
      checkpoint.write(archive.take_pieces(), simulation.strain());
      clock.restart(simulation.strain());
    }



    template <int dim>
    void
    Run<dim>::record(const StepReport &step)
    {
      {
        const auto timer = simulation.report().time("output");
        trajectory->record(step);
      }
      fields->write_if_due(simulation);
    }



    template <int dim>
    void
    Run<dim>::show(const StepReport &step)
    {
      for (const std::string &trouble : step.troubles)
        progress->message(trouble);
      if (parameters.viscoelastic())
        health.look_at(step.extremes,
                       simulation.strain(),
                       *progress,
                       simulation.report());
      Progress::Status status;
      status.strain = simulation.strain();
      if (has_line)
        status.theta =
          simulation.current_state().now.configuration.frame_angle * 180. /
          numbers::PI;
      status.dt         = step.dt;
      status.iterations = step.flow_iterations;
      progress->update(status);
    }



    /// Write a checkpoint if it is due or asked for, and end if that is.
    template <int dim>
    void
    Run<dim>::answer(const Signals &signals)
    {
      const Signals::Request request = signals.pending(communicator);
      if (parameters.checkpoint.enabled &&
          (clock.is_due(simulation.strain()) || request.checkpoint))
        write_checkpoint();
      end_if_asked(request);
    }



    /// @throws Interrupted if the run was asked to end
    template <int dim>
    void
    Run<dim>::end_if_asked(const Signals::Request &request) const
    {
      if (request.end == 0)
        return;
      std::ostringstream text;
      text << "Stopped by " << Signals::name(request.end) << " at strain "
           << simulation.strain()
           << (parameters.checkpoint.enabled ?
                 ": run again with --resume to go on" :
                 " without a checkpoint");
      throw Interrupted(request.end, text.str());
    }



    template <int dim>
    bool
    Run<dim>::is_finished(const StepReport &step) const
    {
      const bool ended = ending != nullptr && ending->reached(simulation, step);
      return ended || simulation.strain() >=
                        parameters.final_strain - ShearProtocol::same_strain;
    }



    template <int dim>
    void
    Run<dim>::go_on()
    {
      const Signals signals;
      bool          finished      = is_finished(StepReport());
      const bool    nothing_to_do = finished;
      while (!finished)
        {
          const StepReport step = simulation.advance();
          record(step);
          show(step);
          finished = is_finished(step);
          answer(signals);
        }
      progress->finish();
      if (parameters.checkpoint.enabled && !nothing_to_do)
        write_checkpoint();
      simulation.report().write(directory);
      simulation.report().print(std::cout);
      // of a sweep, which has other runs to come
      end_if_asked(signals.pending(communicator));
    }



    template <int dim>
    std::string
    Run<dim>::in_context(const std::string &message) const
    {
      std::ostringstream text;
      text << "At strain " << simulation.strain() << ": " << message
           << (message.empty() || message.back() != '.' ? "." : "");
      if (checkpoint.strain())
        text << " The last checkpoint is that of strain "
             << *checkpoint.strain()
             << ": run again with --resume to go on from there.";
      return text.str();
    }



    /// As much of the report as can be written.
    template <int dim>
    void
    Run<dim>::report_failure()
    {
      if (progress)
        progress->finish();
      // a process that fails alone gets no answer from the others
      if (!all_arrive(communicator))
        return;
      try
        {
          simulation.report().write(directory);
        }
      catch (const Error &)
        {
          // what went wrong first is what counts
        }
    }
  } // namespace



  void
  remove_results(const std::string &directory, const MPI_Comm communicator)
  {
    Checkpoint(directory, communicator).clear();
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::error_code there_is_none;
    for (const std::string name :
         {"trajectory.csv", "fields.pvd", "fields", "run_report.txt"})
      std::filesystem::remove_all(directory + "/" + name, there_is_none);
  }



  template <int dim>
  void
  run_simulation(const Scene<dim>                             &scene,
                 const SimulationParameters                   &parameters,
                 const RunOptions                             &options,
                 const MPI_Comm                                communicator,
                 Ending<dim>                                  *ending,
                 const std::function<void(Simulation<dim> &)> &prepare)
  {
    Run<dim> run(scene, parameters, options.directory, communicator, ending);
    if (options.resume)
      run.resume();
    else
      {
        prepare_output_directory(options.directory,
                                 options.overwrite,
                                 communicator);
        remove_results(options.directory, communicator);
      }
    try
      {
        if (!options.resume)
          run.start();
        if (prepare)
          prepare(run.simulation);
        run.go_on();
      }
    catch (const Interrupted &)
      {
        run.report_failure();
        throw;
      }
    catch (...)
      {
        const Error error(run.in_context(present_error_text()));
        run.report_failure();
        throw error;
      }
  }



  template void
  run_simulation<2>(const Scene<2> &,
                    const SimulationParameters &,
                    const RunOptions &,
                    const MPI_Comm,
                    Ending<2> *,
                    const std::function<void(Simulation<2> &)> &);
  template void
  run_simulation<3>(const Scene<3> &,
                    const SimulationParameters &,
                    const RunOptions &,
                    const MPI_Comm,
                    Ending<3> *,
                    const std::function<void(Simulation<3> &)> &);
} // namespace Catena

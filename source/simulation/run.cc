#include <catena/base/program_options.h>
#include <catena/output/field_output.h>
#include <catena/output/progress.h>
#include <catena/simulation/run.h>
#include <catena/simulation/trajectory.h>

#include <algorithm>
#include <iostream>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * Writes the fields once for each strain asked for, at the first instant
     * that has reached it.
     */
    template <int dim>
    class FieldSchedule
    {
    public:
      FieldSchedule(const SimulationParameters &parameters,
                    const std::string          &directory,
                    const MPI_Comm              communicator)
        : strains(parameters.field_strains)
        , modulus(parameters.viscoelastic() ?
                    Giesekus<dim>(parameters.fluid.giesekus).modulus() :
                    0.)
        , output(directory, "fields", communicator)
      {
        std::sort(strains.begin(), strains.end());
      }

      void
      write_if_due(Simulation<dim> &simulation)
      {
        bool due = false;
        for (; next < strains.size() &&
               strains[next] <= simulation.strain() + 1e-9;
             ++next)
          due = true;
        if (!due)
          return;
        const auto        timer = simulation.report().time("output");
        const Level<dim> &now   = simulation.current_state().now;
        const auto       &mesh  = simulation.mesh();
        output.write(now.time,
                     mesh.mapping(),
                     mesh.vector_dofs(),
                     now.flow.velocity,
                     mesh.scalar_dofs(),
                     now.flow.pressure,
                     now.log_conformation,
                     modulus);
      }

    private:
      std::vector<double> strains;
      const double        modulus;
      FieldOutput<dim>    output;
      unsigned int        next = 0;
    };
  } // namespace



  namespace
  {
    /**
     * Says once when the conformation is stretched so far that no mesh of this
     * kind resolves its layers, as in a fluid whose stress has no bound in a
     * steady extension (alpha = 0): such a run may have no steady state.
     */
    class HealthWatch
    {
    public:
      void
      look_at(const ConformationExtremes &extremes,
              const double                strain,
              Progress                   &progress,
              RunReport                  &report)
      {
        largest = std::max(largest, extremes.largest_log);
        report.note("largest |log c|", largest);
        if (warned || largest < suspicious_log)
          return;
        warned = true;
        report.note("health warning from strain", strain);
        std::ostringstream text;
        text << "Warning: at strain " << strain
             << " the log-conformation has reached " << largest
             << ". The stress beside the particles is not resolved, and it may "
                "have no steady state.";
        progress.message(text.str());
      }

    private:
      /// a stretch of e^8 = 3000 in c
      static constexpr double suspicious_log = 8.;

      double largest = 0.;
      bool   warned  = false;
    };
  } // namespace



  template <int dim>
  void
  run_simulation(const Scene<dim>           &scene,
                 const SimulationParameters &parameters,
                 const std::string          &directory,
                 const bool                  overwrite,
                 const MPI_Comm              communicator)
  {
    Simulation<dim> simulation(scene, parameters, communicator);
    prepare_output_directory(directory, overwrite, communicator);
    simulation.initialize();

    Trajectory<dim>    trajectory(directory + "/trajectory.csv",
                               simulation,
                               communicator);
    FieldSchedule<dim> fields(parameters, directory, communicator);
    Progress           progress(simulation.initial_strain(),
                      parameters.final_strain,
                      communicator);
    const auto         record = [&](const StepReport &step) {
      {
        const auto timer = simulation.report().time("output");
        trajectory.record(step);
      }
      fields.write_if_due(simulation);
    };

    HealthWatch health;
    record(StepReport());
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        const StepReport step = simulation.advance();
        record(step);
        if (parameters.viscoelastic())
          health.look_at(step.extremes,
                         simulation.strain(),
                         progress,
                         simulation.report());
        Progress::Status status;
        status.strain = simulation.strain();
        if (scene.line)
          status.theta =
            simulation.current_state().now.configuration.frame_angle * 180. /
            numbers::PI;
        status.dt         = step.dt;
        status.iterations = step.flow_iterations;
        progress.update(status);
      }
    progress.finish();

    simulation.report().write(directory);
    simulation.report().print(std::cout);
  }



  template void
  run_simulation<2>(const Scene<2> &,
                    const SimulationParameters &,
                    const std::string &,
                    const bool,
                    const MPI_Comm);
  template void
  run_simulation<3>(const Scene<3> &,
                    const SimulationParameters &,
                    const std::string &,
                    const bool,
                    const MPI_Comm);
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/base/program_options.h>
#include <catena/base/wall_clock.h>
#include <catena/output/trajectory_table.h>
#include <catena/simulation/checkpoint.h>
#include <catena/simulation/steady_sweep.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  SteadyQuantity<dim>
  rotation_rate()
  {
    return {"rotation_rate",
            "omega",
            "gamma",
            [](const Simulation<dim> &simulation) {
              return simulation.current_state()
                .now.flow.motions[0]
                .angular_velocity[2];
            }};
  }



  template <int dim>
  SteadyQuantity<dim>
  drag_coefficient()
  {
    return {"drag", "K", "", [](const Simulation<dim> &simulation) {
              return -simulation.current_state().now.flow.reactions[0];
            }};
  }



  template <int dim>
  SteadyState<dim>::SteadyState(const SimulationParameters &parameters,
                                const SteadyQuantity<dim>  &quantity,
                                const double                tolerance)
    : quantity(quantity)
    , tolerance(tolerance)
    // an overshoot has no slope at its peak: look at a longer time than its own
    , window(1. + 2. * parameters.fluid.giesekus.weissenberg_number)
    , steady_at_once(!parameters.viscoelastic())
    , begin(wall_clock())
  {}



  template <int dim>
  void
  SteadyState<dim>::add(const double strain, const double value)
  {
    strains.push_back(strain);
    values.push_back(value);
    unsigned int n_old = 0;
    while (n_old + 1 < strains.size() &&
           strains[n_old + 1] <= strain - window + 1e-9)
      ++n_old;
    strains.erase(strains.begin(), strains.begin() + n_old);
    values.erase(values.begin(), values.begin() + n_old);
  }



  /// Largest difference of two values.
  template <int dim>
  double
  SteadyState<dim>::change() const
  {
    if (values.empty())
      return 0.;
    const auto range = std::minmax_element(values.begin(), values.end());
    return *range.second - *range.first;
  }



  template <int dim>
  bool
  SteadyState<dim>::reached(const Simulation<dim> &simulation,
                            const StepReport      &step)
  {
    const MovingMesh<dim> &mesh = simulation.mesh();

    last.seconds  = earlier_seconds + wall_clock() - begin;
    last.value    = quantity.value(simulation);
    last.strain   = simulation.strain();
    last.elements = mesh.n_global_cells();
    last.unknowns = mesh.vector_dofs().n_dofs() + mesh.scalar_dofs().n_dofs();
    if (!steady_at_once)
      last.unknowns +=
        n_symmetric_components(dim) * mesh.scalar_dofs().n_dofs();
    if (step.dt > 0.)
      {
        add(last.strain, last.value);
        ++last.steps;
        last.extremes = step.extremes;
      }
    last.change = change();
    last.steady =
      steady_at_once ||
      (!strains.empty() && strains.back() - strains.front() > window - 1e-9 &&
       last.change < tolerance);
    return last.steady;
  }



  template <int dim>
  void
  SteadyState<dim>::archive(Archive &archive)
  {
    archive(strains,
            values,
            last.steps,
            last.seconds,
            last.extremes.smallest_eigenvalue,
            last.extremes.largest_trace);
    if (archive.is_loading())
      earlier_seconds = last.seconds;
    if (strains.size() != values.size())
      throw CheckpointError("it has strains without a value");
  }



  void
  SteadySweepParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Sweep");
    prm.add_parameter("Rates",
                      rates,
                      "Rates in units of the fluid's own, one run for each: Wi "
                      "of a viscoelastic fluid, lambda_c gamma of a Carreau "
                      "fluid, 0 for the Newtonian limit of either. Without any "
                      "the fluid is taken as it is.");
    prm.add_parameter("Steady tolerance",
                      tolerance,
                      "A run ends when the quantity looked for has changed by "
                      "less than this over the last 1 + 2 Wi of strain, in its "
                      "own unit.",
                      Patterns::Double());
    prm.leave_subsection();
  }



  namespace
  {
    using Model = FluidParameters::Model;

    /// The rate in units of the fluid's own.
    double &
    rate(SimulationParameters &parameters)
    {
      return parameters.fluid.model == Model::carreau ?
               parameters.fluid.carreau.carreau_time :
               parameters.fluid.giesekus.weissenberg_number;
    }

    /// @p parameters at another rate.
    SimulationParameters
    at_rate(SimulationParameters parameters, const double r)
    {
      if (r == 0.)
        parameters.fluid.model = Model::newtonian;
      else
        rate(parameters) = r;
      return parameters;
    }



    const std::string folder_name = "rate_";

    /// Where the run at a rate is recorded.
    std::string
    folder(const std::string &directory, const double r)
    {
      std::ostringstream name;
      name << directory << '/' << folder_name << r;
      return name.str();
    }
  } // namespace



  void
  SteadySweepParameters::check(const SimulationParameters &simulation) const
  {
    std::set<std::string> folders;
    for (const double r : rates)
      {
        require(r >= 0. && std::isfinite(r),
                "Sweep/Rates",
                r,
                "give numbers that are not negative");
        at_rate(simulation, r).check();
        require(folders.insert(folder("", r)).second,
                "Sweep/Rates",
                r,
                "give each rate once; they differ in their first six digits");
      }
    require(rates.empty() || simulation.fluid.model != Model::newtonian,
            "Sweep/Rates",
            rates.empty() ? 0. : rates[0],
            "a Newtonian fluid has no rate of its own: leave it empty");
    require(tolerance > 0.,
            "Sweep/Steady tolerance",
            tolerance,
            "give a positive number");
  }



  namespace
  {
    /// The rates of @p sweep, or that of the fluid.
    std::vector<double>
    all_rates(const SteadySweepParameters &sweep,
              SimulationParameters         parameters)
    {
      if (!sweep.rates.empty())
        return sweep.rates;
      return {parameters.fluid.model == Model::newtonian ? 0. :
                                                           rate(parameters)};
    }



    /**
     * How the run at each rate begins: what has a checkpoint goes on from
     * there, the others were not begun.
     */
    std::vector<RunOptions>
    beginnings(const std::vector<double> &rates,
               const RunOptions          &options,
               const MPI_Comm             communicator)
    {
      std::vector<RunOptions> result;
      bool                    any = false;
      for (const double r : rates)
        {
          const std::string path = folder(options.directory, r);
          const bool        known =
            options.resume && Checkpoint(path, communicator).exists();
          any |= known;
          result.push_back({path, options.overwrite || options.resume, known});
        }
      if (options.resume && !any)
        throw CheckpointError("There is no checkpoint in the folders of '" +
                              options.directory +
                              "': start without --resume, with --overwrite if "
                              "it holds files");
      return result;
    }



    /// Remove what the runs of an earlier sweep left.
    void
    remove_runs(const std::string &directory, const MPI_Comm communicator)
    {
      std::error_code error;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        for (const auto &entry :
             std::filesystem::directory_iterator(directory, error))
          if (entry.is_directory(error) &&
              entry.path().filename().string().find(folder_name) == 0)
            remove_results(entry.path().string(), communicator);
    }



    void
    declare_columns(TrajectoryTable   &table,
                    const std::string &name,
                    const std::string &unit)
    {
      table.declare("rate");
      table.declare(name, unit);
      table.declare("change", unit);
      table.declare("steady");
      table.declare("strain");
      table.declare("smallest_eigenvalue_c");
      table.declare("largest_trace_tau", "G");
      for (const std::string counter : {"steps", "elements", "unknowns"})
        table.declare(counter);
      table.declare("seconds", "s");
    }



    template <typename Result>
    void
    write_row(TrajectoryTable   &table,
              const std::string &name,
              const double       r,
              const Result      &result)
    {
      table.add("rate", r);
      table.add(name, result.value);
      table.add("change", result.change);
      table.add("steady", result.steady ? 1. : 0.);
      table.add("strain", result.strain);
      table.add("smallest_eigenvalue_c", result.extremes.smallest_eigenvalue);
      table.add("largest_trace_tau", result.extremes.largest_trace);
      table.add("steps", result.steps);
      table.add("elements", result.elements);
      table.add("unknowns", result.unknowns);
      table.add("seconds", result.seconds);
      table.write_row();
    }
  } // namespace



  template <int dim>
  void
  steady_sweep(const Scene<dim>            &scene,
               const SimulationParameters  &parameters,
               const SteadySweepParameters &sweep,
               const SteadyQuantity<dim>   &quantity,
               const RunOptions            &options,
               const MPI_Comm               communicator)
  {
    const std::vector<double> rates = all_rates(sweep, parameters);
    const auto                begin = beginnings(rates, options, communicator);
    std::optional<TrajectoryTable> table;
    const auto                     open_table = [&]() {
      table.emplace(options.directory + "/" + quantity.table + ".csv",
                    communicator);
      declare_columns(*table, quantity.name, quantity.unit);
    };
    if (!options.resume)
      {
        prepare_output_directory(options.directory,
                                 options.overwrite,
                                 communicator);
        remove_runs(options.directory, communicator);
        open_table();
      }

    const bool is_writer = Utilities::MPI::this_mpi_process(communicator) == 0;
    for (unsigned int i = 0; i < rates.size(); ++i)
      {
        if (is_writer)
          std::cout << "rate " << rates[i] << std::endl;
        const SimulationParameters at = at_rate(parameters, rates[i]);
        SteadyState<dim>           state(at, quantity, sweep.tolerance);
        run_simulation<dim>(scene, at, begin[i], communicator, &state);
        // a run that is refused leaves the table of the sweep before
        if (!table)
          open_table();
        write_row(*table, quantity.name, rates[i], state.result());
        if (is_writer)
          std::cout << "rate " << rates[i] << ": " << quantity.name << " = "
                    << state.result().value << ' ' << quantity.unit
                    << (state.result().steady ? "" : ", not steady")
                    << std::endl;
      }
  }



#define INSTANTIATE(dim)                                    \
  template SteadyQuantity<dim> rotation_rate();             \
  template SteadyQuantity<dim> drag_coefficient();          \
  template class SteadyState<dim>;                          \
  template void steady_sweep(const Scene<dim> &,            \
                             const SimulationParameters &,  \
                             const SteadySweepParameters &, \
                             const SteadyQuantity<dim> &,   \
                             const RunOptions &,            \
                             const MPI_Comm);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/output/progress.h>
#include <catena/output/trajectory_table.h>
#include <catena/simulation/steady_sweep.h>
#include <catena/simulation/trajectory.h>

#include <algorithm>
#include <deque>
#include <iostream>
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



  namespace
  {
    /**
     * The values of a quantity over a last stretch of strain.
     */
    class Recent
    {
    public:
      explicit Recent(const double window)
        : window(window)
      {}

      void
      add(const double strain, const double value)
      {
        values.emplace_back(strain, value);
        while (values.size() > 1 && values[1].first <= strain - window + 1e-9)
          values.pop_front();
      }

      /// Do the values span the window?
      bool
      is_full() const
      {
        return values.back().first - values.front().first > window - 1e-9;
      }

      /// Largest difference of two values.
      double
      change() const
      {
        const auto range =
          std::minmax_element(values.begin(),
                              values.end(),
                              [](const auto &a, const auto &b) {
                                return a.second < b.second;
                              });
        return range.second->second - range.first->second;
      }

    private:
      const double                          window;
      std::deque<std::pair<double, double>> values; // strain, value
    };
  } // namespace



  template <int dim>
  SteadyResult
  run_to_steady_state(const Scene<dim>           &scene,
                      const SimulationParameters &parameters,
                      const SteadyQuantity<dim>  &quantity,
                      const double                tolerance,
                      const std::string          &path,
                      const MPI_Comm              communicator)
  {
    Simulation<dim> simulation(scene, parameters, communicator);
    simulation.initialize();
    Trajectory<dim> trajectory(path, simulation, communicator);
    trajectory.record(StepReport());

    SteadyResult result;
    result.elements = simulation.mesh().n_global_cells();
    result.unknowns = simulation.mesh().vector_dofs().n_dofs() +
                      simulation.mesh().scalar_dofs().n_dofs();
    result.value  = quantity.value(simulation);
    result.strain = simulation.strain();
    if (!parameters.viscoelastic())
      return result;

    result.unknowns +=
      n_symmetric_components(dim) * simulation.mesh().scalar_dofs().n_dofs();
    Progress progress(simulation.strain(),
                      parameters.final_strain,
                      communicator);
    // an overshoot has no slope at its peak: look at a longer time than its own
    Recent recent(1. + 2. * parameters.fluid.giesekus.weissenberg_number);
    result.steady = false;
    while (!result.steady &&
           simulation.strain() < parameters.final_strain - 1e-9)
      {
        const StepReport step = simulation.advance();
        trajectory.record(step);
        recent.add(simulation.strain(), quantity.value(simulation));
        result.change = recent.change();
        result.steady = recent.is_full() && result.change < tolerance;
        ++result.steps;
        result.extremes = step.extremes;
        progress.update(
          {simulation.strain(), {}, step.dt, step.flow_iterations});
      }
    progress.finish();
    result.value  = quantity.value(simulation);
    result.strain = simulation.strain();
    return result;
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
  } // namespace



  void
  SteadySweepParameters::check(const SimulationParameters &simulation) const
  {
    for (const double r : rates)
      {
        require(r >= 0. && std::isfinite(r),
                "Sweep/Rates",
                r,
                "give numbers that are not negative");
        at_rate(simulation, r).check();
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
    void
    write_row(TrajectoryTable    &table,
              const std::string  &name,
              const double        r,
              const SteadyResult &result,
              const double        seconds)
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
      table.add("seconds", seconds);
      table.write_row();
    }
  } // namespace



  template <int dim>
  void
  steady_sweep(const Scene<dim>            &scene,
               const SimulationParameters  &parameters,
               const SteadySweepParameters &sweep,
               const SteadyQuantity<dim>   &quantity,
               const std::string           &directory,
               const MPI_Comm               communicator)
  {
    TrajectoryTable table(directory + "/" + quantity.table + ".csv",
                          communicator);
    table.declare("rate");
    table.declare(quantity.name, quantity.unit);
    table.declare("change", quantity.unit);
    table.declare("steady");
    table.declare("strain");
    table.declare("smallest_eigenvalue_c");
    table.declare("largest_trace_tau", "G");
    for (const std::string name : {"steps", "elements", "unknowns"})
      table.declare(name);
    table.declare("seconds", "s");

    std::vector<double> rates = sweep.rates;
    if (rates.empty())
      {
        SimulationParameters one = parameters;
        rates.push_back(parameters.fluid.model == Model::newtonian ? 0. :
                                                                     rate(one));
      }
    for (const double r : rates)
      {
        std::ostringstream name;
        name << directory << "/trajectory_" << r << ".csv";
        const double       begin = wall_clock();
        const SteadyResult result =
          run_to_steady_state<dim>(scene,
                                   at_rate(parameters, r),
                                   quantity,
                                   sweep.tolerance,
                                   name.str(),
                                   communicator);
        write_row(table, quantity.name, r, result, wall_clock() - begin);
        if (Utilities::MPI::this_mpi_process(communicator) == 0)
          std::cout << "rate " << r << ": " << quantity.name << " = "
                    << result.value << ' ' << quantity.unit
                    << (result.steady ? "" : ", not steady") << std::endl;
      }
  }



#define INSTANTIATE(dim)                                                         \
  template SteadyQuantity<dim> rotation_rate();                                  \
  template SteadyQuantity<dim> drag_coefficient();                               \
  template SteadyResult        run_to_steady_state(const Scene<dim> &,           \
                                                   const SimulationParameters &, \
                                                   const SteadyQuantity<dim> &,  \
                                                   const double,                 \
                                                   const std::string &,          \
                                                   const MPI_Comm);              \
  template void                steady_sweep(const Scene<dim> &,                  \
                                            const SimulationParameters &,        \
                                            const SteadySweepParameters &,       \
                                            const SteadyQuantity<dim> &,         \
                                            const std::string &,                 \
                                            const MPI_Comm);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Catena

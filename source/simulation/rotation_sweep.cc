#include <catena/base/exceptions.h>
#include <catena/output/progress.h>
#include <catena/output/trajectory_table.h>
#include <catena/simulation/rotation_sweep.h>
#include <catena/simulation/trajectory.h>

#include <algorithm>
#include <deque>
#include <iostream>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  SteadyRotation
  steady_rotation(const Scene<dim>           &scene,
                  const SimulationParameters &parameters,
                  const double                tolerance,
                  const std::string          &path,
                  const MPI_Comm              communicator)
  {
    Simulation<dim> simulation(scene, parameters, communicator);
    simulation.initialize();
    Trajectory<dim> trajectory(path, simulation, communicator);
    trajectory.record(StepReport());

    const auto angular_velocity = [&]() {
      return simulation.current_state().now.flow.motions[0].angular_velocity[2];
    };
    SteadyRotation result;
    result.elements         = simulation.mesh().n_global_cells();
    result.angular_velocity = angular_velocity();
    result.strain           = simulation.strain();
    if (!parameters.viscoelastic())
      return result;

    Progress progress(simulation.strain(),
                      parameters.final_strain,
                      communicator);
    // an overshoot has no slope at its peak: look at a longer time than its own
    const double window =
      1. + 2. * parameters.fluid.giesekus.weissenberg_number;
    std::deque<std::pair<double, double>> recent; // strain, angular velocity
    bool                                  steady = false;
    while (!steady && simulation.strain() < parameters.final_strain - 1e-9)
      {
        const StepReport step = simulation.advance();
        trajectory.record(step);
        recent.emplace_back(simulation.strain(), angular_velocity());
        while (recent.size() > 1 &&
               recent[1].first <= simulation.strain() - window + 1e-9)
          recent.pop_front();
        const auto range =
          std::minmax_element(recent.begin(),
                              recent.end(),
                              [](const auto &a, const auto &b) {
                                return a.second < b.second;
                              });
        result.change = range.second->second - range.first->second;
        steady = simulation.strain() - recent.front().first > window - 1e-9 &&
                 result.change < tolerance;
        ++result.steps;
        progress.update(
          {simulation.strain(), {}, step.dt, step.flow_iterations});
      }
    progress.finish();
    result.angular_velocity = angular_velocity();
    result.strain           = simulation.strain();
    return result;
  }



  void
  RotationSweepParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Sweep");
    prm.add_parameter("Rates",
                      rates,
                      "Shear rates in units of the fluid's own, one run for "
                      "each: Wi of a viscoelastic fluid, lambda_c gamma of a "
                      "Carreau fluid. Without any the fluid is taken as it "
                      "is.");
    prm.add_parameter("Steady tolerance",
                      tolerance,
                      "A run ends when the angular velocity has changed by "
                      "less than this over the last 1 + 2 Wi of strain "
                      "[gamma].",
                      Patterns::Double());
    prm.leave_subsection();
  }



  namespace
  {
    /// The shear rate in units of the fluid's own.
    double &
    rate(SimulationParameters &parameters)
    {
      return parameters.fluid.model == FluidParameters::Model::carreau ?
               parameters.fluid.carreau.carreau_time :
               parameters.fluid.giesekus.weissenberg_number;
    }
  } // namespace



  void
  RotationSweepParameters::check(const SimulationParameters &simulation) const
  {
    for (const double r : rates)
      {
        require(r > 0. && std::isfinite(r),
                "Sweep/Rates",
                r,
                "give positive numbers");
        SimulationParameters parameters = simulation;
        rate(parameters)                = r;
        parameters.check();
      }
    require(rates.empty() ||
              simulation.fluid.model != FluidParameters::Model::newtonian,
            "Sweep/Rates",
            rates.empty() ? 0. : rates[0],
            "a Newtonian fluid has no rate of its own: leave it empty");
    require(tolerance > 0.,
            "Sweep/Steady tolerance",
            tolerance,
            "give a positive number");
  }



  template <int dim>
  void
  rotation_sweep(const Scene<dim>              &scene,
                 const SimulationParameters    &parameters,
                 const RotationSweepParameters &sweep,
                 const std::string             &directory,
                 const MPI_Comm                 communicator)
  {
    const bool newtonian =
      parameters.fluid.model == FluidParameters::Model::newtonian;
    TrajectoryTable table(directory + "/rotation_rate.csv", communicator);
    table.declare("rate");
    table.declare("omega", "gamma");
    table.declare("change", "gamma");
    table.declare("strain");
    table.declare("steps");
    table.declare("elements");
    table.declare("seconds", "s");

    SimulationParameters one   = parameters;
    std::vector<double>  rates = sweep.rates;
    if (rates.empty())
      rates.push_back(newtonian ? 0. : rate(one));
    for (const double r : rates)
      {
        if (!newtonian)
          rate(one) = r;
        std::ostringstream name;
        name << directory << "/trajectory_" << r << ".csv";
        const double         begin  = wall_clock();
        const SteadyRotation result = steady_rotation(
          scene, one, sweep.tolerance, name.str(), communicator);
        table.add("rate", r);
        table.add("omega", result.angular_velocity);
        table.add("change", result.change);
        table.add("strain", result.strain);
        table.add("steps", result.steps);
        table.add("elements", result.elements);
        table.add("seconds", wall_clock() - begin);
        table.write_row();
        if (Utilities::MPI::this_mpi_process(communicator) == 0)
          std::cout << "rate " << r << ": omega = " << result.angular_velocity
                    << " gamma" << std::endl;
      }
  }



  template SteadyRotation
  steady_rotation(const Scene<2> &,
                  const SimulationParameters &,
                  const double,
                  const std::string &,
                  const MPI_Comm);
  template SteadyRotation
  steady_rotation(const Scene<3> &,
                  const SimulationParameters &,
                  const double,
                  const std::string &,
                  const MPI_Comm);
  template void
  rotation_sweep(const Scene<2> &,
                 const SimulationParameters &,
                 const RotationSweepParameters &,
                 const std::string &,
                 const MPI_Comm);
  template void
  rotation_sweep(const Scene<3> &,
                 const SimulationParameters &,
                 const RotationSweepParameters &,
                 const std::string &,
                 const MPI_Comm);
} // namespace Catena

// Everything that can fail in a step is made to fail, at every kind of instant:
// the run goes on and ends where it would have ended. What fails again and
// again ends the run with a message that names strain, cause and checkpoint,
// and with all tables readable; it goes on from there when the cause has gone.
// Not for a Debug build, in which deal.II ends the program at the first value
// that is not finite.

#include <catena/simulation/run.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;

namespace
{
  SimulationParameters
  parameters_of_run()
  {
    auto parameters = Tests::three_discs_parameters(0.4, 0.08);
    parameters.fluid.giesekus.weissenberg_number = 0.4;
    parameters.minimal_gap                       = 0.11;
    parameters.final_strain                      = 1.6;
    parameters.flow_solver.tolerance             = 1e-8;
    parameters.checkpoint.strain_interval        = 0.2;
    return parameters;
  }



  /// One way to fail.
  struct Failure
  {
    std::string                     name;
    StepPart                        part;
    std::function<void(Level<2> &)> happens;
    /// of the report
    std::string counter;
  };



  void
  spoil(VectorType &field, const double value)
  {
    for (const auto i : field.locally_owned_elements())
      {
        field(i) = value;
        break;
      }
    field.update_ghost_values();
  }



  void
  mirror(Level<2> &level)
  {
    for (const auto i : level.positions.locally_owned_elements())
      if (i % 2 == 0)
        level.positions(i) *= -1.;
    level.positions.update_ghost_values();
  }



  const std::string failed_solver = "steps halved because a solver failed",
                    failed_mesh   = "steps halved because there was no mesh";



  std::vector<Failure>
  all_failures()
  {
    const double nan      = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const auto   solver   = [](Level<2> &) {
      throw SolverError("The solver was made to fail.");
    };
    return {{"mesh motion does not converge",
             StepPart::mesh_motion,
             solver,
             failed_solver},
            {"mesh is inverted",
             StepPart::mesh_motion,
             mirror,
             "new meshes for inverted ones"},
            {"mesh is not finite",
             StepPart::mesh_motion,
             [=](Level<2> &level) { spoil(level.positions, nan); },
             "new meshes for inverted ones"},
            {"no new mesh",
             StepPart::mesh_generation,
             [](Level<2> &) {
               throw MeshError("The mesher was made to fail.");
             },
             "new meshes put off"},
            {"transfer does not converge",
             StepPart::mesh_generation,
             solver,
             failed_solver},
            {"balance does not converge",
             StepPart::stress_balance,
             solver,
             failed_solver},
            {"flow does not converge", StepPart::flow, solver, failed_solver},
            {"velocity is not finite",
             StepPart::flow,
             [=](Level<2> &level) { spoil(level.flow.velocity, nan); },
             failed_solver},
            {"pressure is not finite",
             StepPart::flow,
             [=](Level<2> &level) { spoil(level.flow.pressure, infinity); },
             failed_solver},
            {"conformation does not converge",
             StepPart::conformation,
             solver,
             failed_solver},
            {"conformation is not finite",
             StepPart::conformation,
             [=](Level<2> &level) { spoil(level.log_conformation[1], nan); },
             failed_solver},
            {"eigenvalue is not finite",
             StepPart::conformation,
             [](Level<2> &level) { spoil(level.log_conformation[0], 800.); },
             failed_solver},
            {"conformation diverges",
             StepPart::conformation,
             [](Level<2> &level) { level.log_conformation[0].add(3.); },
             failed_solver}};
  }



  /// A run in which @p failure happens once at each of @p strains.
  struct Outcome
  {
    Tests::DiscState discs;
    unsigned int     n_injected = 0, n_counted = 0;
  };



  Outcome
  run(const Failure *failure, const std::vector<double> &strains)
  {
    const auto    parameters = parameters_of_run();
    Simulation<2> simulation(Tests::close_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();
    Outcome           outcome;
    std::vector<char> has_failed(strains.size(), 0);
    if (failure != nullptr)
      simulation.inject_failures([&](const StepPart part, Level<2> &level) {
        for (unsigned int i = 0; i < strains.size(); ++i)
          if (part == failure->part && !has_failed[i] &&
              level.time > strains[i])
            {
              has_failed[i] = 1;
              ++outcome.n_injected;
              failure->happens(level);
              return;
            }
      });
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        // a mesh is asked for where one is to fail
        for (const double strain : strains)
          if (std::abs(simulation.strain() - strain) < 0.04)
            simulation.request_remesh();
        simulation.advance();
      }
    outcome.discs = Tests::state_of_discs(simulation);
    if (failure != nullptr)
      outcome.n_counted = simulation.report().counter(failure->counter);
    return outcome;
  }



  void
  test_recovery(Tests::Claims &claims)
  {
    // held in place, in the ramp, in contact
    const std::vector<double> strains    = {-0.2, 0.3, 0.6, 1.2};
    const Outcome             untouched  = run(nullptr, strains);
    unsigned int              n_injected = 0;
    for (const Failure &failure : all_failures())
      {
        const Outcome outcome = run(&failure, strains);
        n_injected += outcome.n_injected;
        claims.at_least(failure.name + ": happens", outcome.n_injected, 3.);
        claims.at_least(failure.name + ": is counted", outcome.n_counted, 3.);
        claims.at_most(failure.name + ": the run ends in the same place",
                       Tests::distance(outcome.discs.position,
                                       untouched.discs.position),
                       2e-3);
        claims.at_most(failure.name + ": with the same spins",
                       Tests::distance(outcome.discs.spins,
                                       untouched.discs.spins),
                       5e-3);
      }
    std::cout << n_injected << " failures injected" << std::endl;
  }



  /// With three quarters of the iterations that the longest solve takes.
  void
  test_stall(Tests::Claims &claims)
  {
    auto       parameters = parameters_of_run();
    const auto run        = [&](unsigned int &most_iterations) {
      Simulation<2> simulation(Tests::close_discs(),
                               parameters,
                               MPI_COMM_WORLD);
      simulation.initialize();
      most_iterations = 0;
      while (simulation.strain() < parameters.final_strain - 1e-9)
        most_iterations =
          std::max(most_iterations, simulation.advance().flow_iterations);
      claims.near("the solver's run ends",
                  simulation.strain(),
                  parameters.final_strain,
                  1e-9);
      return simulation.report().counter(
               "solves repeated with a fresh preconditioner") +
             simulation.report().counter(
               "solves repeated with a stronger preconditioner") +
             simulation.report().counter(failed_solver);
    };
    unsigned int most = 0;
    claims.near("usually no solve stalls", run(most), 0., 0.);
    parameters.flow_solver.max_iterations = 3 * most / 4;
    claims.at_least("a solve that stalls is repeated, or its step",
                    run(most),
                    1.);
  }



  /// Rows of a table that are complete.
  unsigned int
  n_rows(const std::string &path)
  {
    std::ifstream file(path);
    std::string   line;
    std::getline(file, line);
    const auto   n_columns = std::count(line.begin(), line.end(), ',');
    unsigned int n         = 0;
    while (std::getline(file, line))
      n += std::count(line.begin(), line.end(), ',') == n_columns ? 1 : 1000;
    return n;
  }



  using Injection = Simulation<2>::FailureInjection;



  /// The message with which a run with an @p injection ends.
  std::string
  end_of_run(const Injection   &injection,
             const std::string &folder,
             const bool         resume = false)
  {
    if (!resume &&
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(folder);
    MPI_Barrier(MPI_COMM_WORLD);
    std::ostringstream dark;
    auto *const        screen = std::cout.rdbuf(dark.rdbuf());
    std::string        message;
    try
      {
        run_simulation<2>(Tests::close_discs(),
                          parameters_of_run(),
                          {folder, false, resume},
                          MPI_COMM_WORLD,
                          nullptr,
                          [&](Simulation<2> &simulation) {
                            simulation.inject_failures(injection);
                          });
      }
    catch (const Error &error)
      {
        message = error.what();
      }
    std::cout.rdbuf(screen);
    std::cout << message << std::endl;
    return message;
  }



  /// A failure that goes on for good ends the run at strain @p strain.
  void
  ends(Tests::Claims     &claims,
       const std::string &name,
       const std::string &strain,
       const unsigned int rows,
       const Injection   &injection)
  {
    static unsigned int number  = 0;
    const std::string   folder  = "run_" + std::to_string(number++);
    const std::string   message = end_of_run(injection, folder);
    claims.holds(name + " for good: the message names strain and checkpoint",
                 message.find("At strain " + strain) != std::string::npos &&
                   message.find("checkpoint is that of strain 0.4:") !=
                     std::string::npos &&
                   message.find('\n') == std::string::npos);
    claims.near(name + " for good: the rows so far are there",
                n_rows(folder + "/trajectory.csv"),
                rows,
                0.);
    claims.holds(name + " for good: goes on when it is mended",
                 end_of_run({}, folder, true).empty());
  }



  void
  test_end(Tests::Claims &claims)
  {
    for (const Failure &failure : all_failures())
      // inverted meshes are replaced again and again, and few steps are on a
      // new mesh
      if (failure.counter == failed_solver &&
          failure.part != StepPart::mesh_generation &&
          failure.part != StepPart::stress_balance)
        ends(claims,
             failure.name,
             "0.5",
             13,
             [&](const StepPart part, Level<2> &level) {
               if (part == failure.part && level.time > 0.5)
                 failure.happens(level);
             });
    ends(
      claims, "no mesh", "0.5", 13, [](const StepPart part, Level<2> &level) {
        if (level.time > 0.5 && part == StepPart::mesh_motion)
          mirror(level);
        if (level.time > 0.5 && part == StepPart::mesh_generation)
          throw MeshError("The mesher was made to fail.");
      });
  }



  /// The flow right after the walls have turned back is not found at once.
  void
  test_reversal(Tests::Claims &claims)
  {
    auto parameters             = parameters_of_run();
    parameters.reversal_strains = {0.4};
    const auto run = [&](const unsigned int n_failures, double &strain) {
      Simulation<2> simulation(Tests::close_discs(),
                               parameters,
                               MPI_COMM_WORLD);
      simulation.initialize();
      unsigned int n = 0;
      simulation.inject_failures([&](const StepPart part, Level<2> &level) {
        if (part == StepPart::flow && level.time == simulation.strain() &&
            n < n_failures)
          {
            ++n;
            throw SolverError("The solver was made to fail.");
          }
      });
      try
        {
          while (simulation.strain() < 0.8 - 1e-9)
            simulation.advance();
        }
      catch (const SolverError &)
        {}
      strain = simulation.strain();
      return std::make_pair(Tests::state_of_discs(simulation), n);
    };
    double     strain    = 0.;
    const auto untouched = run(0, strain).first;
    const auto mended    = run(2, strain);
    claims.near("reversal fails twice: happens", mended.second, 2., 0.);
    claims.at_most("reversal fails twice: the run ends in the same place",
                   Tests::distance(mended.first.position, untouched.position),
                   5e-3);
    claims.at_most("reversal fails twice: with the same spins",
                   Tests::distance(mended.first.spins, untouched.spins),
                   5e-3);
    run(1000, strain);
    claims.near("reversal fails for good: the run ends there",
                strain,
                0.4,
                1e-9);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    test_recovery(claims);
    test_stall(claims);
    test_end(claims);
    test_reversal(claims);
  });
}

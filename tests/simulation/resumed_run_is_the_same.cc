// A simulation loaded from what was saved at an instant goes on as the one it
// was saved from: at every instant of a run that is held in place, let go, gets
// into contact and is remeshed, and with each kind of fluid.

#include "../tests.h"

#include "../print.h"
#include "three_discs.h"

using namespace Catena;

namespace
{
  /// What is compared of an instant.
  struct Instant
  {
    double              strain = 0.;
    Tests::DiscState    discs;
    std::vector<double> forces;
    unsigned int        iterations = 0;
  };



  Instant
  advance(Simulation<2> &simulation)
  {
    Instant result;
    result.iterations = simulation.advance().flow_iterations;
    result.strain     = simulation.strain();
    result.discs      = Tests::state_of_discs(simulation);
    result.forces     = simulation.current_state().now.flow.contact_forces;
    return result;
  }



  double
  difference(const Instant &a, const Instant &b)
  {
    double result =
      std::max({std::abs(a.strain - b.strain),
                Tests::distance(a.discs.position, b.discs.position),
                Tests::distance(a.discs.velocity, b.discs.velocity),
                Tests::distance(a.discs.spins, b.discs.spins)});
    if (a.forces.size() != b.forces.size())
      return 1.;
    for (unsigned int c = 0; c < a.forces.size(); ++c)
      result = std::max(result, std::abs(a.forces[c] - b.forces[c]));
    return result;
  }



  SimulationParameters
  parameters_of(const FluidParameters::Model model)
  {
    auto parameters        = Tests::three_discs_parameters(0.5, 0.08);
    parameters.fluid.model = model;
    parameters.fluid.giesekus.weissenberg_number = 0.4;
    parameters.fluid.carreau.carreau_time        = 3.;
    parameters.fluid.carreau.power_index         = 0.5;
    parameters.minimal_gap                       = 0.11;
    parameters.final_strain                      = 2.2;
    // the usual ones: the iterations must be repeated, not their limit
    const SimulationParameters usual;
    parameters.flow_solver.tolerance = usual.flow_solver.tolerance;
    parameters.conformation_solver.tolerance =
      usual.conformation_solver.tolerance;
    return parameters;
  }



  /// Is a new mesh asked for after so many steps?
  bool
  remeshes_after(const unsigned int n_steps)
  {
    return n_steps == 10 || n_steps == 24;
  }



  /// A run with what was saved at each of its instants.
  struct Run
  {
    std::vector<Instant>     instants;
    std::vector<std::string> saved;
    unsigned int             n_remeshes = 0, n_changes_of_contacts = 0;
  };



  /// What is saved on rank 0, on all ranks.
  std::string
  save(Simulation<2> &simulation)
  {
    Archive archive;
    simulation.archive(archive);
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, archive.bytes());
  }



  void
  load(const std::string &bytes, Simulation<2> &simulation)
  {
    Archive archive(bytes);
    simulation.archive(archive);
    archive.finish();
  }



  Run
  whole_run(const SimulationParameters &parameters)
  {
    Simulation<2> simulation(Tests::close_discs(), parameters, MPI_COMM_WORLD);
    simulation.initialize();
    Run  run;
    bool was_held = false;
    while (simulation.strain() < parameters.final_strain - 1e-9)
      {
        if (remeshes_after(run.instants.size()))
          simulation.request_remesh();
        run.saved.push_back(save(simulation));
        run.instants.push_back(advance(simulation));
        const bool is_held = simulation.contact_set().n_held() > 0;
        run.n_changes_of_contacts += is_held != was_held;
        was_held = is_held;
      }
    run.n_remeshes = simulation.report().counter("remeshes");
    return run;
  }



  /// Largest difference over the @p n instants that follow the one saved.
  double
  difference_after(const Run                  &run,
                   const unsigned int          instant,
                   const unsigned int          n,
                   const SimulationParameters &parameters,
                   const MPI_Comm              communicator)
  {
    Simulation<2> simulation(Tests::close_discs(), parameters, communicator);
    load(run.saved[instant], simulation);
    double largest = 0.;
    for (unsigned int i = instant;
         i < std::min<std::size_t>(instant + n, run.instants.size());
         ++i)
      {
        if (remeshes_after(i))
          simulation.request_remesh();
        const Instant now = advance(simulation);
        largest           = std::max(largest, difference(now, run.instants[i]));
        if (now.iterations != run.instants[i].iterations)
          Tests::print("iterations ",
                       now.iterations,
                       " and ",
                       run.instants[i].iterations);
      }
    Tests::print("from strain ",
                 run.instants[instant].strain,
                 ": difference ",
                 largest);
    return largest;
  }



  void
  test_giesekus(Tests::Claims &claims)
  {
    const auto parameters = parameters_of(FluidParameters::Model::giesekus);
    const Run  run        = whole_run(parameters);
    claims.at_least("the mesh is changed", run.n_remeshes, 2.);
    claims.at_least("contacts change", run.n_changes_of_contacts, 1.);
    double largest = 0.;
    for (unsigned int i = 0; i < run.saved.size(); ++i)
      largest =
        std::max(largest,
                 difference_after(run, i, 3, parameters, MPI_COMM_WORLD));
    claims.at_most("three steps from every instant are the same",
                   largest,
                   1e-10);
    claims.at_most(
      "all steps from an instant in the ramp are the same",
      difference_after(run, 9, run.saved.size(), parameters, MPI_COMM_WORLD),
      1e-10);
  }



  void
  test_others(Tests::Claims &claims)
  {
    for (const auto &fluid :
         {std::make_pair("Newtonian", FluidParameters::Model::newtonian),
          std::make_pair("Carreau", FluidParameters::Model::carreau)})
      {
        const auto parameters = parameters_of(fluid.second);
        const Run  run        = whole_run(parameters);
        claims.at_most(std::string("a ") + fluid.first +
                         " fluid goes on the same",
                       difference_after(
                         run, 8, run.saved.size(), parameters, MPI_COMM_WORLD),
                       1e-10);
      }
  }



  /// With solvers so tight that their tolerance does not matter.
  void
  test_other_number_of_ranks(Tests::Claims &claims)
  {
    auto parameters = parameters_of(FluidParameters::Model::giesekus);
    parameters.flow_solver.tolerance         = 1e-10;
    parameters.conformation_solver.tolerance = 1e-12;
    parameters.final_strain                  = 1.4;
    const Run run                            = whole_run(parameters);
    double    largest                        = 0.;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      largest =
        difference_after(run, 9, run.saved.size(), parameters, MPI_COMM_SELF);
    claims.at_most("one rank goes on where all ranks have stopped",
                   dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD),
                   1e-7);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    test_giesekus(claims);
    test_others(claims);
    test_other_number_of_ranks(claims);
  });
}

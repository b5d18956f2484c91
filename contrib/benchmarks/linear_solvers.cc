/**
 * The flow of some time steps of three particles at the smallest gap in a
 * viscoelastic fluid, solved with Catena's solver and with those that the
 * published method uses:
 *
 *   linear_solvers N_PART N_MIN STRAIN STEPS SOLVER...
 *
 * A simulation to STRAIN records its last STEPS steps (fewer if a new mesh was
 * made among them); every SOLVER then solves them from the same first guesses,
 * if not said otherwise, to the same residual. It is one of
 *
 * - catena,
 * - ilut:FILL:DROP:metis|rcm:mixed|last: GMRES with incomplete factors of the
 *   whole matrix, kept from the first step on; with :extrapolated after it the
 *   first guesses are not improved by earlier solutions,
 * - mumps: complete factors instead.
 *
 * Printed is a row of comma-separated values for each. Times are CPU seconds,
 * memory is what a solver adds at most, limit the time that reading
 * coefficients, matrices and basis takes for a solution of Catena's at least.
 * README.md tells more.
 */

#include <catena/base/release_memory.h>
#include <catena/flow/earlier_solutions.h>
#include <catena/flow/flow_assembly.h>
#include <catena/flow/flow_operator.h>
#include <catena/flow/flow_unknowns.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/scene/line_of_particles.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_solver.h>

#include <fstream>
#include <iostream>
#include <memory>

#include "cpu_seconds.h"
#include "ilut.h"
#include "memory_traffic.h"
#include "recorded_steps.h"
#include "whole_system.h"

using namespace dealii;
using namespace Catena;

namespace
{
  constexpr double minimal_gap = 0.02;

  struct Costs
  {
    std::string  settings;
    double       set_up = 0., solve_from_zero = 0., assembly = 0., solve = 0.;
    unsigned int iterations_from_zero = 0;
    double       iterations = 0., memory = 0., difference = 0., limit = 0.;
  };



  double
  largest_difference(const std::vector<RigidMotion<3>> &a,
                     const std::vector<RigidMotion<3>> &b)
  {
    double result = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      result =
        std::max({result,
                  (a[i].velocity - b[i].velocity).norm(),
                  (a[i].angular_velocity - b[i].angular_velocity).norm()});
    return result;
  }



  /**
   * Solves the first step from zero, then all of them from their first guess.
   */
  class Solver
  {
  public:
    Solver(MovingMesh<3>            &mesh,
           const RigidBodies<3>     &bodies,
           const GiesekusParameters &fluid)
      : mesh(mesh)
      , bodies(bodies)
      , fluid(fluid)
      , known_conformation(mesh)
    {}

    virtual ~Solver() = default;

    Costs
    run(const std::deque<RecordedStep> &steps)
    {
      // the peak of the memory is counted from here
      release_memory();
      std::ofstream("/proc/self/clear_refs") << 5;
      Utilities::System::MemoryStats before, after;
      Utilities::System::get_memory_stats(before);

      Costs costs;
      mesh.set_positions(steps[0].positions);
      first_assembly(steps[0], costs);
      FlowFields<3> fields  = imposed_flow(mesh, steps[0].configuration, false);
      costs.solve_from_zero = cpu_seconds(
        [&] { costs.iterations_from_zero = solve(fields, steps[0].forces); });

      for (const RecordedStep &step : steps)
        {
          mesh.set_positions(step.positions);
          const auto stress = stress_of(step);
          costs.assembly += cpu_seconds([&] { assemble(step, stress); });
          prepare(stress);
          fields = step.first_guess;
          costs.solve += cpu_seconds(
            [&] { costs.iterations += solve(fields, step.forces); });
          costs.difference =
            std::max(costs.difference,
                     largest_difference(fields.motions, step.motions));
        }
      costs.assembly /= steps.size();
      costs.solve /= steps.size();
      costs.iterations /= steps.size();
      costs.set_up -= first_assembly_counts ? costs.assembly : 0.;
      Utilities::System::get_memory_stats(after);
      costs.memory = (after.VmHWM - before.VmRSS) / 1024.;
      costs.limit  = limit(costs.iterations);
      return costs;
    }

  protected:
    MovingMesh<3>            &mesh;
    const RigidBodies<3>     &bodies;
    const GiesekusParameters &fluid;
    /// does the set-up include an assembly?
    bool first_assembly_counts = false;

    StressPrediction<3>
    stress_of(const RecordedStep &step)
    {
      return step.stress(mesh, fluid, known_conformation);
    }

    virtual void
    first_assembly(const RecordedStep &step, Costs &costs) = 0;

    virtual void
    assemble(const RecordedStep &step, const StressModel<3> &stress) = 0;

    /// What is not timed.
    virtual void
    prepare(const StressModel<3> &)
    {}

    virtual unsigned int
    solve(FlowFields<3> &fields, const std::vector<double> &forces) = 0;

    /// Seconds that the memory allows a solution, if known.
    virtual double
    limit(const double /*iterations*/) const
    {
      return 0.;
    }

  private:
    StressPrediction<3>::KnownConformation known_conformation;
  };



  class CatenaSolver : public Solver
  {
  public:
    using Solver::Solver;

  private:
    FlowSolver<3>    solver = FlowSolver<3>(FlowSolverParameters());
    Configuration<3> configuration;

    void
    first_assembly(const RecordedStep &step, Costs &costs) override
    {
      first_assembly_counts = true;
      configuration         = step.configuration;
      solver.reinit(mesh, bodies, step.configuration, false);
      costs.set_up = cpu_seconds(
        [&] { solver.assemble(step.configuration, stress_of(step)); });
    }

    void
    assemble(const RecordedStep &step, const StressModel<3> &stress) override
    {
      solver.assemble(step.configuration, stress);
    }

    unsigned int
    solve(FlowFields<3> &fields, const std::vector<double> &forces) override
    {
      return solver.solve(fields, {}, forces);
    }

    double
    limit(const double iterations) const override
    {
      const auto couplings = node_couplings<3>(
        mesh, velocity_constraints<3>(mesh, bodies, configuration, false));
      FlowSystem<3>             system(mesh, bodies, couplings);
      PreconditionerMatrices<3> matrices(mesh, couplings);
      matrices.clear();
      return bytes_of_a_solution(system, matrices, iterations) /
             memory_bandwidth();
    }
  };



  /**
   * GMRES with factors of the whole matrix, kept.
   */
  class FactorSolver : public Solver
  {
  public:
    FactorSolver(MovingMesh<3>            &mesh,
                 const RigidBodies<3>     &bodies,
                 const GiesekusParameters &fluid,
                 const std::string        &settings)
      : Solver(mesh, bodies, fluid)
      , words(Utilities::split_string_list(settings, ':'))
    {
      AssertThrow(settings == "mumps" || words.size() == 5 ||
                    (words.size() == 6 && !improves()),
                  ExcMessage("Unknown solver " + settings));
    }

    /// Do earlier solutions improve the first guesses?
    bool
    improves() const
    {
      return words.back() != "extrapolated";
    }

    void
    vmult(Vector<double> &dst, const Vector<double> &src) const
    {
      if (words[0] == "mumps")
        {
          std::copy(src.begin(), src.end(), direct_src.begin());
          direct->solve(direct_dst, direct_src);
          std::copy(direct_dst.begin(), direct_dst.end(), dst.begin());
        }
      else
        ilut.vmult(dst, src);
    }

  private:
    mutable VectorType                              direct_src, direct_dst;
    const std::vector<std::string>                  words;
    std::vector<NodeCoupling<3>>                    couplings;
    std::unique_ptr<FlowSystem<3>>                  flow;
    std::unique_ptr<WholeSystem>                    system;
    CompressedRows                                  matrix;
    Configuration<3>                                configuration;
    EarlierSolutions<3>                             earlier_solutions;
    Ilut                                            ilut;
    std::unique_ptr<TrilinosWrappers::SparseMatrix> copy;
    SolverControl                                   direct_control;
    std::unique_ptr<TrilinosWrappers::SolverDirect> direct;

    void
    first_assembly(const RecordedStep &step, Costs &costs) override
    {
      configuration = step.configuration;
      find_couplings();
      flow = std::make_unique<FlowSystem<3>>(mesh, bodies, couplings);
      const bool is_ilut = words[0] == "ilut";
      system             = std::make_unique<WholeSystem>(mesh,
                                             couplings,
                                             bodies.n_unknowns(),
                                             is_ilut ? words[3] : "metis",
                                             is_ilut && words[4] == "last");
      matrix             = system->pattern(couplings);
      const auto stress  = stress_of(step);
      assemble(step, stress);
      prepare(stress);
      if (is_ilut)
        {
          costs.set_up = cpu_seconds([&] {
            ilut.initialize(matrix, std::stoi(words[1]), std::stod(words[2]));
          });
          std::cerr << "# entries of the factors per entry of the matrix: "
                    << 1. * ilut.n_entries() / matrix.values.size() << '\n';
        }
      else
        {
          copy_for_trilinos();
          direct_src.reinit(complete_index_set(matrix.n()), MPI_COMM_SELF);
          direct_dst.reinit(direct_src);
          direct = std::make_unique<TrilinosWrappers::SolverDirect>(
            direct_control,
            TrilinosWrappers::SolverDirect::AdditionalData(false,
                                                           "Amesos_Mumps"));
          costs.set_up = cpu_seconds([&] { direct->initialize(*copy); });
        }
    }

    void
    find_couplings()
    {
      couplings = node_couplings<3>(
        mesh, velocity_constraints<3>(mesh, bodies, configuration, false));
    }

    void
    assemble(const RecordedStep &step, const StressModel<3> &stress) override
    {
      configuration = step.configuration;
      find_couplings();
      system->assemble(couplings, stress, matrix);
      earlier_solutions.begin_instant();
    }

    void
    prepare(const StressModel<3> &stress) override
    {
      assemble_flow<3>(stress, Scene<3>::imposed_gradient(), *flow, nullptr);
    }

    void
    copy_for_trilinos()
    {
      std::vector<unsigned int> lengths;
      for (unsigned int i = 0; i < matrix.n(); ++i)
        lengths.push_back(matrix.row_starts[i + 1] - matrix.row_starts[i]);
      copy = std::make_unique<TrilinosWrappers::SparseMatrix>(matrix.n(),
                                                              matrix.n(),
                                                              lengths);
      for (unsigned int i = 0; i < matrix.n(); ++i)
        {
          const auto                           begin = matrix.row_starts[i];
          std::vector<types::global_dof_index> columns(matrix.columns.begin() +
                                                         begin,
                                                       matrix.columns.begin() +
                                                         begin + lengths[i]);
          copy->set(i, lengths[i], columns.data(), &matrix.values[begin]);
        }
      copy->compress(VectorOperation::insert);
    }

    unsigned int
    solve(FlowFields<3> &fields, const std::vector<double> &forces) override
    {
      const FlowUnknowns<3> unknowns{
        mesh, bodies, configuration, false, couplings, *flow};
      const ContactBlocks   no_contacts;
      const BlockVectorType rhs = unknowns.right_hand_side(no_contacts, forces);
      BlockVectorType       guess = unknowns.first_guess(fields, {});
      const double wanted = FlowSolverParameters().tolerance * rhs.l2_norm();
      if (improves())
        earlier_solutions.improve(FlowOperator<3, float>{*flow, no_contacts},
                                  rhs,
                                  wanted,
                                  guess);
      // one pressure is zero in the whole system
      guess.block(1).add(-guess.block(1)(system->zero_pressure()));
      Vector<double>                              x = system->gather(guess);
      const Vector<double>                        b = system->gather(rhs);
      SolverControl                               control(1000, wanted);
      SolverGMRES<Vector<double>>::AdditionalData data(202, true);
      SolverGMRES<Vector<double>>(control, data).solve(matrix, x, b, *this);

      system->scatter(x, guess);
      earlier_solutions.remember(guess);
      unknowns.extract_velocity(guess, fields);
      return control.last_step();
    }
  };



  void
  compare(const MeshParameters           &mesh_parameters,
          const double                    strain,
          const unsigned int              n_steps,
          const std::vector<std::string> &solvers)
  {
    LineOfParticlesParameters line(3);
    line.distance        = 2. + 2. * minimal_gap;
    const Scene<3> scene = line.scene<3>();

    SimulationParameters parameters;
    parameters.fluid.giesekus.weissenberg_number      = 3.;
    parameters.fluid.giesekus.mobility_parameter      = 0.1;
    parameters.fluid.giesekus.solvent_viscosity_ratio = 0.1;
    parameters.mesh                                   = mesh_parameters;
    parameters.minimal_gap                            = minimal_gap;
    Simulation<3> simulation(scene, parameters, MPI_COMM_WORLD);
    const auto    steps = recorded_steps(simulation, strain, n_steps);
    AssertThrow(!steps.empty(),
                ExcMessage("A new mesh was made in the last step: choose "
                           "another strain."));
    MovingMesh<3>       &mesh = *simulation.current_state().discretization.mesh;
    const RigidBodies<3> bodies(scene);

    std::cout << "solver,cells,unknowns,steps,set_up,iterations_from_zero,"
                 "solve_from_zero,assembly,iterations,solve,memory_MB,"
                 "difference,limit\n";
    for (const std::string &name : solvers)
      {
        std::unique_ptr<Solver> solver;
        if (name == "catena")
          solver = std::make_unique<CatenaSolver>(mesh,
                                                  bodies,
                                                  parameters.fluid.giesekus);
        else
          solver = std::make_unique<FactorSolver>(mesh,
                                                  bodies,
                                                  parameters.fluid.giesekus,
                                                  name);
        try
          {
            const Costs c = solver->run(steps);
            std::cout << name << ',' << mesh.n_global_cells() << ','
                      << mesh.vector_dofs().n_dofs() +
                           mesh.scalar_dofs().n_dofs()
                      << ',' << steps.size() << ',' << c.set_up << ','
                      << c.iterations_from_zero << ',' << c.solve_from_zero
                      << ',' << c.assembly << ',' << c.iterations << ','
                      << c.solve << ',' << c.memory << ',' << c.difference
                      << ',' << c.limit << std::endl;
          }
        catch (const SolverControl::NoConvergence &)
          {
            std::cout << name << ",no convergence" << std::endl;
          }
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 6)
    {
      std::cerr
        << "Usage: linear_solvers N_PART N_MIN STRAIN STEPS SOLVER...\n";
      return 1;
    }
  MeshParameters parameters;
  parameters.elements_on_equator = std::stoi(argv[1]);
  parameters.elements_across_gap = std::stoi(argv[2]);
  try
    {
      compare(parameters,
              std::stod(argv[3]),
              std::stoi(argv[4]),
              std::vector<std::string>(argv + 5, argv + argc));
    }
  catch (const std::exception &error)
    {
      std::cerr << "linear_solvers: " << error.what() << '\n';
      return 1;
    }
  return 0;
}

#include <catena/base/exceptions.h>
#include <catena/flow/flow_assembly.h>
#include <catena/flow/flow_operator.h>
#include <catena/flow/flow_solver.h>
#include <catena/flow/refined_gmres.h>
#include <catena/flow/velocity_constraints.h>

#include <deal.II/lac/solver_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  void
  FlowSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Residual of momentum and mass, relative to the "
                      "right-hand side of the disturbance problem.",
                      Patterns::Double());
    prm.add_parameter("Maximal iterations",
                      max_iterations,
                      "Iterations after which a solve has failed.",
                      Patterns::Integer(0));
  }



  void
  FlowSolverParameters::check() const
  {
    require(tolerance >= 1e-14 && tolerance < 1e-2,
            "Flow solver/Tolerance",
            tolerance,
            "choose a value between 1e-14 and 1e-2");
    require(max_iterations >= 1 && max_iterations < 100000,
            "Flow solver/Maximal iterations",
            max_iterations,
            "choose a positive number, 300 is usual");
  }



  namespace
  {
    /// error of a contact force against the norm of the residual, usually,
    /// and at most, where a tight network makes the problem stiff
    constexpr double usual_force_error = 300., largest_force_error = 3e4;
  } // namespace



  template <int dim>
  FlowSolver<dim>::FlowSolver(const FlowSolverParameters &parameters)
    : parameters(parameters)
  {}



  template <int dim>
  void
  FlowSolver<dim>::reinit(const MovingMesh<dim>    &new_mesh,
                          const RigidBodies<dim>   &new_bodies,
                          const Configuration<dim> &new_configuration,
                          const bool                held_in_place)
  {
    mesh   = &new_mesh;
    bodies = &new_bodies;
    held   = held_in_place;
    set_configuration(new_configuration);
    // the former ones first: together they would take twice the memory
    preconditioner.clear();
    system.reset();
    preconditioner_matrices.reset();
    system = std::make_unique<FlowSystem<dim>>(*mesh, *bodies, couplings);
    preconditioner_matrices =
      std::make_unique<PreconditionerMatrices<dim>>(*mesh, couplings);
    preconditioner_is_due = true;
    earlier_solutions.clear();
  }



  template <int dim>
  void
  FlowSolver<dim>::assemble(const Configuration<dim> &new_configuration,
                            const StressModel<dim>   &stress,
                            const Function<dim>      *body_force)
  {
    set_configuration(new_configuration);
    last_stress = &stress;
    last_force  = body_force;
    earlier_solutions.begin_instant();
    assemble_system();
  }



  template <int dim>
  void
  FlowSolver<dim>::set_configuration(
    const Configuration<dim> &new_configuration)
  {
    configuration = new_configuration;
    const AffineConstraints<double> constraints =
      velocity_constraints<dim>(*mesh, *bodies, configuration, held);
    // the former ones first, whose memory these take
    couplings = std::vector<NodeCoupling<dim>>();
    couplings = node_couplings<dim>(*mesh, constraints);
  }



  template <int dim>
  void
  FlowSolver<dim>::impose_constraints(
    const Configuration<dim> &new_configuration,
    FlowFields<dim>          &fields)
  {
    set_configuration(new_configuration);
    unknowns().extract_velocity(unknowns().first_guess(fields, {}), fields);
  }



  template <int dim>
  FlowUnknowns<dim>
  FlowSolver<dim>::unknowns() const
  {
    return {*mesh, *bodies, configuration, held, couplings, *system};
  }



  template <int dim>
  void
  FlowSolver<dim>::assemble_system()
  {
    // the former one first: together they would take twice the memory
    if (preconditioner_is_due)
      preconditioner.clear();
    assemble_flow(*last_stress,
                  configuration.shear_rate * mesh->scene().imposed_gradient(),
                  *system,
                  preconditioner_is_due ? preconditioner_matrices.get() :
                                          nullptr,
                  last_force);
    if (!std::isfinite(system->velocity_rhs.l2_norm()))
      throw SolverError("The stress has values that are not finite: use a "
                        "smaller time step or a finer mesh.");
    preconditioner_is_fresh = preconditioner_is_due;
    if (preconditioner_is_due)
      {
        preconditioner.initialize(
          *mesh, couplings, *system, *preconditioner_matrices, configuration);
        preconditioner_matrices->release_components();
      }
    preconditioner_is_due = false;
  }



  /// Norm of the residual to which the equations are solved.
  template <int dim>
  double
  FlowSolver<dim>::target(const BlockVectorType &rhs) const
  {
    return wanted_residual > 0. ? wanted_residual :
                                  parameters.tolerance * rhs.l2_norm();
  }



  template <int dim>
  FlowResidual
  FlowSolver<dim>::residual(const FlowFields<dim>           &fields,
                            const std::vector<Contact<dim>> &contacts,
                            const std::vector<double> &external_forces) const
  {
    const ContactBlocks   blocks = unknowns().contact_blocks(contacts);
    const BlockVectorType rhs =
      unknowns().right_hand_side(blocks, external_forces);
    std::vector<double> forces = fields.contact_forces;
    forces.resize(contacts.size());
    const BlockVectorType solution = unknowns().first_guess(fields, forces);
    BlockVectorType       left     = unknowns().make_vector(contacts.size());
    FlowOperator<dim, double>{*system, blocks}.vmult(left, solution);
    left -= rhs;
    if (contacts.size() > 0)
      for (const auto c : left.block(3).locally_owned_elements())
        if (solution.block(3)(c) == 0.)
          left.block(3)(c) = 0.;

    FlowResidual result;
    result.norm            = left.l2_norm();
    result.right_hand_side = rhs.l2_norm();
    result.rounding        = system->rounding(fields.velocity);
    return result;
  }



  /**
   * From the first guess @p solution, improved by earlier solutions.
   */
  template <int dim>
  unsigned int
  FlowSolver<dim>::iterate(BlockVectorType       &solution,
                           const BlockVectorType &rhs,
                           const ContactBlocks   &contacts)
  {
    const bool   is_of_an_instant = wanted_residual == 0.;
    const double wanted           = target(rhs);
    if (is_of_an_instant)
      earlier_solutions.improve(FlowOperator<dim, float>{*system, contacts},
                                rhs,
                                RefinedGmres<dim>::single_precision_share *
                                  wanted,
                                solution);
    preconditioner.set_contacts(contacts);
    const auto result =
      RefinedGmres<dim>(*system, contacts, preconditioner)
        .solve(solution, rhs, wanted, parameters.max_iterations);
    decades = result.decades;
    unknowns().normalise_pressure(solution.block(1));
    if (is_of_an_instant)
      earlier_solutions.remember(solution);
    return result.iterations;
  }



  template <int dim>
  unsigned int
  FlowSolver<dim>::solve(FlowFields<dim>                 &fields,
                         const std::vector<Contact<dim>> &candidates,
                         const std::vector<double>       &external_forces)
  {
    const unsigned int  m      = candidates.size();
    const ContactBlocks blocks = unknowns().contact_blocks(candidates);
    if (fields.contact_forces.size() != m)
      fields.contact_forces.assign(m, 0.);
    if (m == 0)
      {
        const unsigned int iterations =
          solve_with({}, blocks, external_forces, fields);
        judge_preconditioner(iterations);
        return iterations;
      }

    const double residual =
      target(unknowns().right_hand_side(ContactBlocks(), external_forces));
    const unsigned int max_solutions = 10 + 2 * m;
    double             force_error   = usual_force_error;
    unsigned int       iterations    = 0;
    ActingContacts     acting(preconditioner.rigid_resistance(),
                          blocks,
                          unknowns().global_unknowns(fields),
                          fields.contact_forces);
    for (unsigned int n = 0; n < max_solutions; ++n)
      {
        iterations += solve_with(acting.set(), blocks, external_forces, fields);
        if (n == 0)
          judge_preconditioner(iterations);
        if (acting.are_found(unknowns().global_unknowns(fields),
                             fields.contact_forces,
                             force_error * residual))
          {
            for (double &force : fields.contact_forces)
              force = std::max(0., force);
            return iterations;
          }
        force_error = std::min(2. * force_error, largest_force_error);
      }
    std::ostringstream text;
    text << "Which of " << m << " contacts repel was not found in "
         << max_solutions << " solutions of the flow: lower 'Flow "
         << "solver/Tolerance'.";
    throw SolverError(text.str());
  }



  /**
   * Solve with the contacts of @p set as equations, in place of @p fields.
   */
  template <int dim>
  unsigned int
  FlowSolver<dim>::solve_with(const std::vector<bool>   &set,
                              const ContactBlocks       &candidates,
                              const std::vector<double> &external_forces,
                              FlowFields<dim>           &fields)
  {
    const ContactBlocks blocks = candidates.subset(set);
    std::vector<double> forces;
    for (unsigned int c = 0; c < set.size(); ++c)
      if (set[c])
        forces.push_back(fields.contact_forces[c]);
    BlockVectorType rhs   = unknowns().right_hand_side(blocks, external_forces);
    const auto      guess = unknowns().first_guess(fields, forces);
    BlockVectorType solution;
    unsigned int    iterations = 0;
    for (bool solved = false; !solved;)
      try
        {
          solution   = guess;
          iterations = iterate(solution, rhs, blocks);
          solved     = true;
        }
      catch (const SolverControl::NoConvergence &failure)
        {
          if (improve_preconditioner())
            continue;
          std::ostringstream text;
          text << "The flow solver reached a residual of "
               << failure.last_residual << " in " << failure.last_step
               << " iterations, " << target(rhs)
               << " was asked for: raise 'Flow solver/Maximal iterations' or "
                  "use a smaller time step.";
          throw SolverError(text.str());
        }
    if (!std::isfinite(solution.l2_norm()))
      throw SolverError("The flow solver gave values that are not finite.");

    unknowns().extract(solution, set, fields);
    return iterations;
  }



  /**
   * After a solve that stalled: a fresh preconditioner, then a stronger one.
   * @return whether there was a better one
   */
  template <int dim>
  bool
  FlowSolver<dim>::improve_preconditioner()
  {
    if (!preconditioner_is_fresh)
      {
        ++repeated.with_fresh_preconditioner;
        preconditioner_is_due = true;
        assemble_system();
        return true;
      }
    if (!preconditioner.is_strong())
      {
        ++repeated.with_stronger_preconditioner;
        preconditioner.strengthen();
        // for this instant only: checkpoints know of usual ones
        preconditioner_is_due = true;
        return true;
      }
    return false;
  }



  /// From the first solve after an assembly.
  template <int dim>
  void
  FlowSolver<dim>::judge_preconditioner(const unsigned int iterations)
  {
    if (preconditioner_is_fresh)
      {
        best_rate       = std::numeric_limits<double>::max();
        iterations_lost = 0.;
      }
    // a shorter solve says too little, a longer one had nothing to do
    if (decades > 0.5 && decades < 20.)
      {
        best_rate = std::min(best_rate, iterations / decades);
        iterations_lost += iterations - best_rate * decades;
      }
    preconditioner_is_due = preconditioner.is_strong() ||
                            iterations_lost > preconditioner.set_up_cost();
  }



  template <int dim>
  types::global_dof_index
  FlowSolver<dim>::n_unknowns() const
  {
    return mesh->vector_dofs().n_dofs() + mesh->scalar_dofs().n_dofs() +
           system->n_rigid();
  }



  template <int dim>
  void
  FlowSolver<dim>::archive(FieldArchive<dim> &archive)
  {
    const unsigned int here =
      Utilities::MPI::n_mpi_processes(mesh->communicator());
    unsigned int n_ranks = here;
    archive(preconditioner_is_due, best_rate, iterations_lost, n_ranks);
    earlier_solutions.archive(archive, [&](const unsigned int n_contacts) {
      return unknowns().make_vector(n_contacts);
    });
    // of identified nodes other ones carry the unknowns on other ranks
    if (n_ranks != here)
      earlier_solutions.clear();
  }



  template class FlowSolver<2>;
  template class FlowSolver<3>;
} // namespace Catena

#ifndef catena_flow_flow_solver_h
#define catena_flow_flow_solver_h

#include <catena/flow/earlier_solutions.h>
#include <catena/flow/flow_preconditioner.h>
#include <catena/flow/flow_system.h>
#include <catena/flow/flow_unknowns.h>
#include <catena/flow/stress_model.h>
#include <catena/particles/contacts.h>
#include <catena/scene/configuration.h>

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Controls of the linear solver of momentum and mass.
   */
  struct FlowSolverParameters
  {
    /// residual against the right-hand side of the disturbance problem
    double       tolerance      = 1e-6;
    unsigned int max_iterations = 300;

    /// Declare the entries in the current subsection.
    void
    declare(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * What is left of the balance of momentum, mass and particles, as the norm of
   * the vector of all equations.
   */
  struct FlowResidual
  {
    double norm = 0.;
    /// of the disturbance problem's right-hand side
    double right_hand_side = 0.;
    /// what rounding leaves
    double rounding = 0.;
  };



  /**
   * Solves the balance of momentum and mass of the fluid together with that
   * of the particles,
   *
   *   force and torque of the fluid + F_external + F_r = 0,
   *
   * and, in a pressure-driven scene, with the flow rate,
   * for the disturbance of the imposed shear flow, by RefinedGmres with
   * FlowPreconditioner, from a first guess improved by EarlierSolutions. The
   * preconditioner is kept
   * until the iterations lost since it was made, against its best solve by
   * decades of the residual, would have paid for a new one.
   */
  template <int dim>
  class FlowSolver
  {
  public:
    explicit FlowSolver(const FlowSolverParameters &parameters);

    /// What it solves refers to its constraints.
    FlowSolver(const FlowSolver &) = delete;

    /**
     * A new mesh, or other particles held in place. References are kept.
     */
    void
    reinit(const MovingMesh<dim>    &mesh,
           const RigidBodies<dim>   &bodies,
           const Configuration<dim> &configuration,
           const bool                held_in_place);

    /**
     * Assemble at the mesh's current positions, and make a new preconditioner
     * if it is due. Stress and force are kept by reference as long as solves
     * follow: one that stalls assembles again.
     * @throws SolverError if the stress is not finite
     */
    void
    assemble(const Configuration<dim>    &configuration,
             const StressModel<dim>      &stress,
             const dealii::Function<dim> *body_force = nullptr);

    /**
     * Solve with @p fields as first guess, also for the contact forces if they
     * are one for each candidate.
     *
     * Every contact has F_r >= 0, a gap rate >= 0, and one of them zero: the
     * repelling ones are equations, found by ActingContacts with the
     * preconditioner's resistance of the particles. As long as they are those
     * that this predicts from the first guess, there is one linear solve.
     *
     * @param candidates all contacts; their forces, in @p fields afterwards,
     * may be zero
     * @param external_forces on the whole particles, by rigid-body unknown
     * @return number of iterations
     * @throws SolverError if it fails also with a fresh preconditioner and a
     * stronger one, or if the repelling contacts are not found
     */
    unsigned int
    solve(FlowFields<dim>                 &fields,
          const std::vector<Contact<dim>> &candidates,
          const std::vector<double>       &external_forces);

    /**
     * Residual to which the coming solves go, in place of the tolerance of the
     * parameters; 0: that tolerance again. As steps of a nonlinear iteration
     * they start from the first guess as it is: one made of earlier steps can
     * have a residual so small that nothing would be left to solve.
     */
    void
    solve_to(const double residual)
    {
      wanted_residual = residual;
    }

    /// Make a new preconditioner in the next assembly.
    void
    renew_preconditioner()
    {
      preconditioner_is_due = true;
    }

    /// Was the preconditioner made of the stress that is assembled now?
    bool
    has_fresh_preconditioner() const
    {
      return preconditioner_is_fresh;
    }

    /// How often a solve has stalled, and what was done about it.
    struct RepeatedSolves
    {
      /// it had a preconditioner from before, and then a fresh one
      unsigned int with_fresh_preconditioner = 0;
      /// it had a fresh preconditioner, and then a stronger one
      unsigned int with_stronger_preconditioner = 0;
    };

    const RepeatedSolves &
    repeated_solves() const
    {
      return repeated;
    }

    /**
     * Save or load what the next solve depends on, but for the preconditioner:
     * it is to be made first, by an assembly like the one it was made of.
     */
    void
    archive(FieldArchive<dim> &archive);

    /**
     * The residual of the assembled equations at @p fields, which satisfy the
     * constraints. With a stress linearised about @p fields it is that of the
     * nonlinear equations. A contact takes part when it carries a force.
     */
    FlowResidual
    residual(const FlowFields<dim>           &fields,
             const std::vector<Contact<dim>> &contacts,
             const std::vector<double>       &external_forces) const;

    /**
     * Give the velocity its values on walls, symmetry planes and, by their
     * motions, particles. An assembly has to follow before anything is solved.
     */
    void
    impose_constraints(const Configuration<dim> &configuration,
                       FlowFields<dim>          &fields);

    /// Number of velocity, pressure, rigid-body unknowns together.
    dealii::types::global_dof_index
    n_unknowns() const;

  private:
    const FlowSolverParameters   parameters;
    const MovingMesh<dim>       *mesh        = nullptr;
    const RigidBodies<dim>      *bodies      = nullptr;
    const StressModel<dim>      *last_stress = nullptr;
    const dealii::Function<dim> *last_force  = nullptr;
    Configuration<dim>           configuration;
    bool                         held = false;

    std::vector<NodeCoupling<dim>>               couplings;
    std::unique_ptr<FlowSystem<dim>>             system;
    std::unique_ptr<PreconditionerMatrices<dim>> preconditioner_matrices;
    FlowPreconditioner<dim>                      preconditioner;
    EarlierSolutions<dim>                        earlier_solutions;
    bool preconditioner_is_due = true, preconditioner_is_fresh = false;
    /// iterations for a decade of the residual; their excess over the best
    double         best_rate = 0., iterations_lost = 0.;
    double         wanted_residual = 0., decades = 0.;
    RepeatedSolves repeated;

    void
    set_configuration(const Configuration<dim> &configuration);

    FlowUnknowns<dim>
    unknowns() const;

    void
    assemble_system();

    double
    target(const BlockVectorType &rhs) const;

    unsigned int
    solve_with(const std::vector<bool>   &set,
               const ContactBlocks       &candidates,
               const std::vector<double> &external_forces,
               FlowFields<dim>           &fields);

    unsigned int
    iterate(BlockVectorType       &solution,
            const BlockVectorType &rhs,
            const ContactBlocks   &contacts);

    bool
    improve_preconditioner();

    void
    judge_preconditioner(const unsigned int iterations);
  };
} // namespace Catena

#endif

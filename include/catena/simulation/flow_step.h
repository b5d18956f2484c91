#ifndef catena_simulation_flow_step_h
#define catena_simulation_flow_step_h

#include <catena/flow/flow_solver.h>
#include <catena/flow/nonlinear_flow_solver.h>
#include <catena/flow/stress_prediction.h>
#include <catena/output/run_report.h>
#include <catena/particles/contacts.h>
#include <catena/simulation/parameters.h>
#include <catena/simulation/state.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * The part of a time step in which the flow at its end is solved for: chooses
   * the stress of the fluid, and solves.
   */
  template <int dim>
  class FlowStep
  {
  public:
    /// Both are kept by reference.
    FlowStep(const SimulationParameters &parameters, RunReport &run_report);

    /// A new mesh, or other particles held in place. References are kept.
    void
    reinit(MovingMesh<dim>          &mesh,
           const RigidBodies<dim>   &bodies,
           const Configuration<dim> &configuration,
           const bool                held_in_place);

    /**
     * Solve for the flow of @p next, with that as first guess.
     *
     * @param now, before the levels from which the stress is predicted
     * @param contacts hold the forces of the last step
     * @return number of linear iterations
     * @throws SolverError
     */
    unsigned int
    solve(Level<dim>                &next,
          const TimeStep            &step,
          const Level<dim>          &now,
          const Level<dim>          &before,
          const VectorType          &mesh_velocity,
          const std::vector<double> &external_forces,
          const Contacts<dim>       &contacts);

    /**
     * Of @p next, the flow of which was solved for last, and the
     * log-conformation afterwards, in place of the tensors it has there.
     */
    void
    find_unresolved_conformation(Level<dim> &next);

    /**
     * Balance the stress of @p state, which has been transferred to this mesh,
     * by StressBalance at its last instant; that before gets the same addition,
     * lest it count as a rate. Leaves the mesh at the positions of the last
     * instant.
     *
     * @param forces on the whole particles, by rigid-body unknown
     * @return number of linear iterations
     * @throws SolverError
     */
    unsigned int
    balance_stress(State<dim> &state, const std::vector<double> &forces);

    /// Make a new preconditioner in the next solve.
    void
    renew_preconditioner()
    {
      flow_solver.renew_preconditioner();
    }

    dealii::types::global_dof_index
    n_unknowns() const
    {
      return flow_solver.n_unknowns();
    }

    /**
     * Save or load what makes the next solve depend on those before: the
     * earlier solutions, and what the preconditioner was made of. After
     * loading, the mesh is at the positions of that instant.
     */
    void
    archive(FieldArchive<dim> &archive);

  private:
    /// What the stress of an instant depends on, and where it was.
    struct Instant
    {
      Configuration<dim>      configuration;
      VectorType              positions;
      TimeStep                step;
      std::vector<VectorType> log_conformation, old_log_conformation;
      /// that about which the stress of a Carreau fluid is linearised
      VectorType    velocity;
      Linearisation linearisation = Linearisation::picard;

      void
      archive(FieldArchive<dim> &archive);
    };

    const SimulationParameters               &parameters;
    RunReport                                &run_report;
    MovingMesh<dim>                          *mesh   = nullptr;
    const RigidBodies<dim>                   *bodies = nullptr;
    FlowSolver<dim>                           flow_solver;
    typename FlowSolver<dim>::RepeatedSolves  counted;
    std::unique_ptr<NonlinearFlowSolver<dim>> nonlinear_solver;

    /// Of this one the preconditioner was made.
    Instant preconditioner_instant;

    /// On which the stress of a viscoelastic fluid depends.
    using Conformation      = typename StressPrediction<dim>::Conformation;
    using Motion            = typename StressPrediction<dim>::Motion;
    using KnownConformation = typename StressPrediction<dim>::KnownConformation;

    /// Of the last solve in a viscoelastic fluid, until
    /// find_unresolved_conformation().
    std::unique_ptr<Motion>                motion;
    std::unique_ptr<StressPrediction<dim>> prediction;
    KnownConformation                      known_conformation;

    std::unique_ptr<Motion>
    motion_towards(const Level<dim> &next,
                   const TimeStep   &step,
                   const Level<dim> &now,
                   const VectorType &mesh_velocity) const;

    std::unique_ptr<StressPrediction<dim>>
    predict(const TimeStep     &step,
            const Conformation &now,
            const Conformation &before,
            const Motion       &motion);

    /// Does the stress of a step have a part with the smooth rate of strain?
    bool
    has_numerical_viscosity(const TimeStep &step) const;

    /// Make the preconditioner again of what it was made of.
    void
    assemble_preconditioner();

    unsigned int
    solve_nonlinear(Level<dim>                      &next,
                    const std::vector<Contact<dim>> &candidates,
                    const std::vector<double>       &external_forces);

    unsigned int
    solve_linear(Level<dim>                      &next,
                 const TimeStep                  &step,
                 const Level<dim>                &now,
                 const Level<dim>                &before,
                 const VectorType                &mesh_velocity,
                 const std::vector<Contact<dim>> &candidates,
                 const std::vector<double>       &external_forces);

    void
    count_repeated_solves();

    void
    find_reactions(Level<dim> &level, const StressModel<dim> &stress) const;
  };
} // namespace Catena

#endif

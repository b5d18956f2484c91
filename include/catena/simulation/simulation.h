#ifndef catena_simulation_simulation_h
#define catena_simulation_simulation_h

#include <catena/base/exceptions.h>
#include <catena/output/run_report.h>
#include <catena/particles/contacts.h>
#include <catena/simulation/flow_step.h>
#include <catena/simulation/parameters.h>
#include <catena/simulation/remesher.h>
#include <catena/simulation/shear_protocol.h>
#include <catena/simulation/state.h>
#include <catena/simulation/step_control.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Catena
{
  /**
   * What one time step did.
   */
  struct StepReport
  {
    double       dt = 0.;
    StepError    error;
    unsigned int flow_iterations         = 0;
    unsigned int conformation_iterations = 0;
    bool         remeshed                = false;
    /// of the conformation after the step
    ConformationExtremes extremes;
    double               seconds = 0.;
    /// what went wrong on the way, and what was done about it
    std::vector<std::string> troubles;
  };



  /**
   * The parts of a step that can fail.
   */
  enum class StepPart
  {
    mesh_motion,
    mesh_generation,
    stress_balance,
    flow,
    conformation
  };



  /**
   * The time stepping of the whole system: particles, mesh, flow and
   * conformation. A viscoelastic simulation starts from rest with the
   * particles held in place for one relaxation time, t in [-Wi, 0]; the force
   * that holds them is then let go to zero over the release strain. A
   * Newtonian or Carreau fluid, or a scene whose particles only turn, starts
   * free at t = 0.
   *
   * @code
   * Simulation<3> simulation(scene, parameters, MPI_COMM_WORLD);
   * simulation.initialize();
   * while (simulation.strain() < parameters.final_strain - 1e-9)
   *   simulation.advance();
   * @endcode
   */
  template <int dim>
  class Simulation
  {
  public:
    /**
     * @throws InputError if scene and parameters are not acceptable
     */
    Simulation(const Scene<dim>           &scene,
               const SimulationParameters &parameters,
               const MPI_Comm              communicator);

    /**
     * Make the first mesh and the state at the start.
     * @throws MeshError or SolverError
     */
    void
    initialize();

    /**
     * One time step. What can be done about a failure is tried in this order:
     *
     * - a linear solver stalls: again with a fresh preconditioner, then with a
     *   stronger one;
     * - a new mesh is needed, and there is none: go on with the old one for a
     *   while if it is still good enough;
     * - a solver fails, a value is not finite or the error is too large, or
     *   the old mesh is not good enough: again with half the step and a fresh
     *   preconditioner.
     *
     * A mesh that is inverted at the end of a step is made anew from the last
     * good instant. All of this is counted in the report.
     *
     * @throws SolverError if the shortest step fails; the state is still that
     * before the step
     */
    StepReport
    advance();

    /**
     * Called in every part of a step that can fail, before what it gives is
     * used: after the positions of the nodes have been found, before a mesh is
     * made, before the stress is balanced on it, after the flow and after the
     * conformation have been found. For tests, which can throw SolverError and
     * MeshError there and damage the level.
     */
    using FailureInjection = std::function<void(const StepPart, Level<dim> &)>;

    void
    inject_failures(const FailureInjection &injection)
    {
      failure_injection = injection;
    }

    /// Make a new mesh in the next step in any case.
    void
    request_remesh()
    {
      remesh_requested = true;
    }

    double
    strain() const
    {
      return state.now.time;
    }

    /// Strain at which the simulation starts, 0 or minus the start-up.
    double
    initial_strain() const;

    const Scene<dim> &
    initial_scene() const
    {
      return scene;
    }

    const State<dim> &
    current_state() const
    {
      return state;
    }

    const MovingMesh<dim> &
    mesh() const
    {
      return *state.discretization.mesh;
    }

    const RigidBodies<dim> &
    rigid_bodies() const
    {
      return bodies;
    }

    const Contacts<dim> &
    contact_set() const
    {
      return contacts;
    }

    /// The external forces that act now, by rigid-body unknown.
    std::vector<double>
    external_forces(const double time) const;

    /// On the particles now, by what holds them and by their contacts, by
    /// rigid-body unknown.
    std::vector<double>
    present_forces() const;

    RunReport &
    report()
    {
      return run_report;
    }

    /**
     * Save everything the next step depends on, or load it in place of
     * initialize(). On the same number of ranks the steps are then the same
     * as without, to rounding; on another one, to the tolerances of the
     * solvers. Collective; what rank 0 saves is what all ranks load.
     *
     * @throws CheckpointError if what is loaded is not of this simulation
     */
    void
    archive(Archive &archive);

    bool
    held_in_place() const
    {
      return held;
    }

  private:
    const Scene<dim>           scene;
    const SimulationParameters parameters;
    const MPI_Comm             communicator;
    const Remesher<dim>        remesher;

    RunReport                                run_report;
    RigidBodies<dim>                         bodies;
    const ShearProtocol                      protocol;
    Contacts<dim>                            contacts;
    FlowStep<dim>                            flow_step;
    std::unique_ptr<ConformationSolver<dim>> conformation_solver;
    StepControl                              step_control;
    State<dim>                               state;
    FailureInjection                         failure_injection;
    bool                                     held             = false;
    bool                                     remesh_requested = false;

    double
    next_dt() const;

    bool
    try_step(Level<dim> &next, StepReport &report);

    bool
    reverse_shear(StepReport &report);

    Configuration<dim>
    moved_particles(const TimeStep &step);

    void
    take_step(const TimeStep &step, Level<dim> &next, StepReport &report);

    void
    tell_jump(const Level<dim> &next, StepReport &report) const;

    void
    shorten_step(const TimeStep    &step,
                 const std::string &cause,
                 const Error       &error,
                 StepReport        &report);

    void
    move_mesh(Level<dim> &next, StepReport &report);

    void
    change_mesh(Level<dim> &next, StepReport &report);

    void
    count_attempts();

    void
    hold_contacts();

    void
    inject(const StepPart part, Level<dim> &next);

    unsigned int
    solve_flow(Level<dim>       &next,
               const TimeStep   &step,
               const VectorType &mesh_velocity);

    unsigned int
    solve_conformation(Level<dim>       &next,
                       const TimeStep   &step,
                       const VectorType &mesh_velocity);

    void
    let_go();

    void
    set_up_solvers();
  };

} // namespace Catena

#endif

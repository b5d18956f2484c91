#include <catena/base/exceptions.h>
#include <catena/base/release_memory.h>
#include <catena/base/replace_field.h>
#include <catena/base/wall_clock.h>
#include <catena/simulation/extrapolation.h>
#include <catena/simulation/simulation.h>
#include <catena/simulation/step_error.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Is there a particle to be held while a viscoelastic stress builds up?
    template <int dim>
    bool
    starts_held(const SimulationParameters &parameters,
                const RigidBodies<dim>     &bodies)
    {
      bool any_moves = false;
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        any_moves |= !bodies.unknown(k).rotation &&
                     !bodies.is_fixed(bodies.unknown(k).particle);
      return parameters.viscoelastic() && any_moves;
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(const Scene<dim>           &scene,
                              const SimulationParameters &parameters,
                              const MPI_Comm              communicator)
    : scene(scene)
    , parameters(parameters)
    , communicator(communicator)
    , remesher(scene, parameters, communicator)
    , run_report(communicator)
    , bodies(scene)
    , protocol(parameters,
               starts_held<dim>(parameters, bodies),
               !scene.pressure_driven())
    , contacts(scene, parameters.minimal_gap)
    , flow_step(this->parameters, run_report)
    , step_control(parameters.step_control)
  {
    parameters.check();
    parameters.check_scene(scene);
    if (parameters.viscoelastic())
      conformation_solver = std::make_unique<ConformationSolver<dim>>(
        Giesekus<dim>(parameters.fluid.giesekus),
        parameters.conformation_solver);
  }



  template <int dim>
  double
  Simulation<dim>::initial_strain() const
  {
    return protocol.start();
  }



  template <int dim>
  void
  Simulation<dim>::initialize()
  {
    Level<dim> &now = state.now;
    now.time        = initial_strain();
    held            = protocol.holds(now.time);
    bodies.hold_in_place(held);
    state.holding_forces.assign(bodies.n_unknowns(), 0.);

    for (const Particle<dim> &p : scene.particles)
      now.configuration.centres.push_back(p.centre);
    now.configuration.shear_rate  = protocol.shear_rate(now.time);
    now.configuration.frame_angle = scene.line_angle(now.configuration.centres);
    contacts.enforce(now.configuration);

    {
      const auto timer     = run_report.time("mesh generation and transfer");
      state.discretization = remesher.make(now.configuration);
    }
    set_up_solvers();
    count_attempts();
    now.positions = mesh().positions();

    now.flow = imposed_flow(mesh(), now.configuration, held);
    now.flow.reactions.assign(bodies.n_unknowns(), 0.);

    if (parameters.viscoelastic())
      now.log_conformation = mesh().tensor_field();
    else
      {
        solve_flow(now, TimeStep(), VectorType());
        hold_contacts();
      }
  }



  template <int dim>
  void
  Simulation<dim>::set_up_solvers()
  {
    const auto timer = run_report.time("degrees of freedom and sparsity");
    flow_step.reinit(*state.discretization.mesh,
                     bodies,
                     state.now.configuration,
                     held);
    if (conformation_solver)
      conformation_solver->reinit(mesh());
    // what the mesher and the transfer of fields have left
    release_memory();
    run_report.note("elements", mesh().n_global_cells());
    run_report.note("unknowns of the flow", flow_step.n_unknowns());
    run_report.note("unknowns of the conformation",
                    conformation_solver ? n_symmetric_components(dim) *
                                            mesh().scalar_dofs().n_dofs() :
                                          0);
  }



  /**
   * The wanted step, but not over an instant at which something is due: what is
   * left until then is divided evenly among the last steps. These are ten where
   * steps are controlled, so that each is hardly shortened, and two of constant
   * ones, so that the others keep their length.
   */
  template <int dim>
  double
  Simulation<dim>::next_dt() const
  {
    constexpr double rounding = 1e-3;
    const double     n_last = parameters.step_control.tolerance > 0. ? 10. : 2.;
    const double     now    = state.now.time;
    const double     left   = protocol.next_instant(now) - now;
    const double     wanted = step_control.next_step();
    const double     n_left = std::max(1., std::ceil(left / wanted - rounding));
    return n_left > n_last ? wanted : left / n_left;
  }



  template <int dim>
  StepReport
  Simulation<dim>::advance()
  {
    const auto   step_timer = run_report.step();
    const double begin      = wall_clock();
    StepReport   result;
    if (state.now.configuration.shear_rate !=
        protocol.shear_rate(state.now.time))
      {
        step_control.restart();
        while (!reverse_shear(result))
          run_report.count("rejected steps");
      }

    Level<dim> next;
    while (!try_step(next, result))
      run_report.count("rejected steps");

    const bool last_held_step = held && !protocol.holds(next.time);
    if (conformation_solver)
      {
        // in the place of one that is not needed any more
        next.unresolved_conformation =
          std::move(state.before.unresolved_conformation);
        flow_step.find_unresolved_conformation(next);
        next.is_balanced = state.last_dt > 0.;
      }
    state.before  = std::move(state.now);
    state.now     = std::move(next);
    state.last_dt = result.dt;
    hold_contacts();
    if (last_held_step)
      let_go();

    run_report.count("flow iterations", result.flow_iterations);
    run_report.count("remeshes", result.remeshed ? 1 : 0);
    result.seconds = wall_clock() - begin;
    return result;
  }



  /**
   * A step from the present state to @p next.
   * @return whether it is good enough; if not, a shorter one is due
   */
  template <int dim>
  bool
  Simulation<dim>::try_step(Level<dim> &next, StepReport &report)
  {
    TimeStep step;
    step.dt          = next_dt();
    step.previous_dt = state.last_dt;
    try
      {
        take_step(step, next, report);
        if (!step_control.accept(step.dt, report.error))
          return false;
        tell_jump(next, report);
        return true;
      }
    catch (const SolverError &error)
      {
        shorten_step(step, "a solver failed", error, report);
      }
    catch (const MeshError &error)
      {
        shorten_step(step, "there was no mesh", error, report);
      }
    return false;
  }



  /**
   * If the stress has jumped where a new mesh does not resolve it.
   */
  template <int dim>
  void
  Simulation<dim>::tell_jump(const Level<dim> &next, StepReport &report) const
  {
    if (!(report.error.largest_change > StepError::failing_change))
      return;
    std::ostringstream text;
    text << "At strain " << next.time << " the log-conformation jumps by "
         << report.error.largest_change
         << " where the new mesh does not resolve it.";
    report.troubles.push_back(text.str());
  }



  /**
   * @throws SolverError or MeshError
   */
  template <int dim>
  void
  Simulation<dim>::take_step(const TimeStep &step,
                             Level<dim>     &next,
                             StepReport     &report)
  {
    next               = Level<dim>();
    next.time          = state.now.time + step.dt;
    next.configuration = moved_particles(step);
    move_mesh(next, report);
    const VectorType velocity_of_mesh = mesh_velocity(state, next, step);

    next.flow = extrapolated_flow(state, step);
    report.flow_iterations += solve_flow(next, step, velocity_of_mesh);
    inject(StepPart::flow, next);
    const auto predicted  = extrapolated_log_conformation(state, step);
    next.log_conformation = predicted;
    if (conformation_solver)
      {
        report.conformation_iterations =
          solve_conformation(next, step, velocity_of_mesh);
        inject(StepPart::conformation, next);
      }
    report.dt = step.dt;
    report.error =
      step_error<dim>(state, next, predicted, step, held, report.remeshed);
    if (conformation_solver)
      report.extremes =
        conformation_extremes<dim>(mesh(), next.log_conformation);
  }



  /**
   * @throws SolverError with the message of @p error if that step is the
   * shortest
   */
  template <int dim>
  void
  Simulation<dim>::shorten_step(const TimeStep    &step,
                                const std::string &cause,
                                const Error       &error,
                                StepReport        &report)
  {
    std::ostringstream text;
    if (!step_control.shorten(step.dt))
      {
        text << "The shortest time step, " << step.dt
             << ", fails: " << error.what();
        throw SolverError(text.str());
      }
    flow_step.renew_preconditioner();
    run_report.count("steps halved because " + cause);
    text << "At strain " << state.now.time << " a step of " << step.dt
         << " is halved: " << error.what();
    report.troubles.push_back(text.str());
  }



  /**
   * Those of the present state: a rejected step leaves no trace.
   */
  template <int dim>
  void
  Simulation<dim>::hold_contacts()
  {
    contacts.remember(contacts.candidates(state.now.configuration),
                      state.now.flow.contact_forces);
  }



  template <int dim>
  void
  Simulation<dim>::inject(const StepPart part, Level<dim> &next)
  {
    if (failure_injection)
      failure_injection(part, next);
  }



  /**
   * The walls turn back: the velocities jump, and those of the past tell
   * nothing about the next step. The stress of a viscoelastic fluid is the one
   * predicted with a step of first order.
   *
   * @return whether the flow was found; if not, the state is that before, and a
   * shorter step is due
   */
  template <int dim>
  bool
  Simulation<dim>::reverse_shear(StepReport &report)
  {
    Level<dim>           &now    = state.now;
    const FlowFields<dim> before = now.flow;
    now.configuration.shear_rate *= -1.;
    now.flow.velocity *= -1.;
    now.flow.pressure *= -1.;
    for (RigidMotion<dim> &motion : now.flow.motions)
      {
        motion.velocity *= -1.;
        motion.angular_velocity *= -1.;
      }

    TimeStep step;
    step.dt = step_control.next_step();
    try
      {
        report.flow_iterations += solve_flow(now, step, mesh().vector_field());
        inject(StepPart::flow, now);
        hold_contacts();
        state.last_dt   = 0.;
        now.is_balanced = false;
        return true;
      }
    catch (const SolverError &error)
      {
        now.configuration.shear_rate *= -1.;
        now.flow = before;
        now.flow.velocity.update_ghost_values();
        now.flow.pressure.update_ghost_values();
        shorten_step(step, "a solver failed", error, report);
      }
    return false;
  }



  /**
   * X^(n+1) by Adams-Bashforth, then back to the smallest gap where it would
   * be undercut or is held.
   */
  template <int dim>
  Configuration<dim>
  Simulation<dim>::moved_particles(const TimeStep &step)
  {
    Configuration<dim> next = state.now.configuration;
    if (held)
      return next;

    const TwoLevelWeights weights = step.adams_bashforth();
    for (unsigned int i = 0; i < next.centres.size(); ++i)
      {
        next.centres[i] +=
          step.dt * weights.b0 * state.now.flow.motions[i].velocity;
        if (weights.b1 != 0.)
          next.centres[i] +=
            step.dt * weights.b1 * state.before.flow.motions[i].velocity;
      }
    contacts.enforce(next);
    // a string turned by half a turn is the same string
    const double turn = scene.line_angle(next.centres) -
                        scene.line_angle(state.now.configuration.centres);
    next.frame_angle += std::remainder(turn, numbers::PI);
    return next;
  }



  template <int dim>
  void
  Simulation<dim>::move_mesh(Level<dim> &next, StepReport &report)
  {
    const Configuration<dim> &present = state.now.configuration;
    bool moved = next.configuration.frame_angle != present.frame_angle;
    for (unsigned int i = 0; i < present.centres.size(); ++i)
      moved |= next.configuration.centres[i] != present.centres[i];
    if (!moved && !remesh_requested)
      {
        next.positions = state.now.positions;
        return;
      }

    bool remesh = remesh_requested;
    {
      const auto timer = run_report.time("mesh motion");
      next.positions =
        state.discretization.mover->positions(next.configuration);
      inject(StepPart::mesh_motion, next);
      state.discretization.mesh->set_positions(next.positions);
      remesh |= remesher.is_due(state.discretization, next.configuration);
    }
    if (remesh)
      change_mesh(next, report);
  }



  /**
   * Put @p next on a new mesh. Without one, the old one has to do if it has
   * half of the quality at which a new one is wanted.
   */
  template <int dim>
  void
  Simulation<dim>::change_mesh(Level<dim> &next, StepReport &report)
  {
    const double quality = mesh().quality();
    if (!(quality > 0.))
      run_report.count("new meshes for inverted ones");
    try
      {
        const auto timer = run_report.time("mesh generation and transfer");
        inject(StepPart::mesh_generation, next);
        remesher.remesh(state, next.configuration);
        replace_field(next.positions, mesh().positions());
      }
    catch (const MeshError &error)
      {
        if (!(quality > 0.5 * parameters.remesh_quality *
                          state.discretization.initial_quality))
          throw;
        run_report.count("new meshes put off");
        std::ostringstream text;
        text << "At strain " << next.time
             << " a new mesh is put off: " << error.what();
        report.troubles.push_back(text.str());
        return;
      }
    set_up_solvers();
    count_attempts();
    report.remeshed = true;
    // where the balance fails, the next attempt is one on another new mesh
    remesh_requested = true;
    if (state.now.is_balanced)
      {
        inject(StepPart::stress_balance, next);
        report.flow_iterations +=
          flow_step.balance_stress(state, present_forces());
        state.discretization.mesh->set_positions(next.positions);
      }
    remesh_requested = false;
  }



  template <int dim>
  std::vector<double>
  Simulation<dim>::present_forces() const
  {
    const auto candidates = contacts.candidates(state.now.configuration);
    std::vector<double> forces =
      forces_on_particles(candidates,
                          contacts.remembered_forces(candidates),
                          bodies);
    const std::vector<double> external = external_forces(state.now.time);
    for (unsigned int k = 0; k < forces.size(); ++k)
      forces[k] += external[k];
    return forces;
  }



  template <int dim>
  void
  Simulation<dim>::count_attempts()
  {
    if (state.discretization.attempts > 1)
      run_report.count("attempts at meshes that failed",
                       state.discretization.attempts - 1);
  }



  /**
   * With the flow of @p next as first guess.
   */
  template <int dim>
  unsigned int
  Simulation<dim>::solve_flow(Level<dim>       &next,
                              const TimeStep   &step,
                              const VectorType &mesh_velocity)
  {
    return flow_step.solve(next,
                           step,
                           state.now,
                           state.before,
                           mesh_velocity,
                           external_forces(next.time),
                           contacts);
  }



  /**
   * With the log-conformation of @p next as first guess.
   */
  template <int dim>
  unsigned int
  Simulation<dim>::solve_conformation(Level<dim>       &next,
                                      const TimeStep   &step,
                                      const VectorType &mesh_velocity)
  {
    const auto  timer  = run_report.time("conformation");
    const auto &now    = state.now.log_conformation;
    const auto &before = state.before.log_conformation.empty() ?
                           now :
                           state.before.log_conformation;
    return conformation_solver->solve(next.log_conformation,
                                      now,
                                      before,
                                      next.flow.velocity,
                                      mesh_velocity,
                                      step);
  }



  /**
   * The particles are free from now on; what held them is let go gradually.
   */
  template <int dim>
  void
  Simulation<dim>::let_go()
  {
    state.now.time       = 0.;
    state.holding_forces = state.now.flow.reactions;
    held                 = false;
    step_control.restart();
    bodies.hold_in_place(false);
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      if (bodies.unknown(k).rotation ||
          bodies.is_fixed(bodies.unknown(k).particle))
        state.holding_forces[k] = 0.;
    set_up_solvers();
  }



  template <int dim>
  std::vector<double>
  Simulation<dim>::external_forces(const double time) const
  {
    std::vector<double> forces = state.holding_forces;
    for (double &force : forces)
      force *= protocol.holding_share(time);
    return forces;
  }



  template <int dim>
  void
  Simulation<dim>::archive(Archive &archive)
  {
    archive(held, remesh_requested, step_control, contacts);
    state.archive(archive, scene, communicator);
    if (archive.is_loading())
      {
        bodies.hold_in_place(held);
        if (state.holding_forces.size() != bodies.n_unknowns() ||
            state.now.flow.motions.size() != scene.particles.size() ||
            state.now.log_conformation.empty() == parameters.viscoelastic())
          throw CheckpointError("it is of another simulation");
        set_up_solvers();
      }
    FieldArchive<dim> fields(archive, mesh());
    flow_step.archive(fields);
    if (archive.is_loading())
      state.discretization.mesh->set_positions(state.now.positions);
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Catena

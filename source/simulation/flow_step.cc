#include <catena/conformation/strain_rate_projection.h>
#include <catena/flow/carreau_stress.h>
#include <catena/flow/particle_forces.h>
#include <catena/simulation/flow_step.h>
#include <catena/simulation/stress_balance.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowStep<dim>::FlowStep(const SimulationParameters &parameters,
                          RunReport                  &run_report)
    : parameters(parameters)
    , run_report(run_report)
    , flow_solver(parameters.flow_solver)
  {
    if (parameters.fluid.model == FluidParameters::Model::carreau)
      nonlinear_solver =
        std::make_unique<NonlinearFlowSolver<dim>>(flow_solver,
                                                   Carreau(
                                                     parameters.fluid.carreau),
                                                   parameters.nonlinear_solver);
  }



  template <int dim>
  void
  FlowStep<dim>::reinit(MovingMesh<dim>          &new_mesh,
                        const RigidBodies<dim>   &new_bodies,
                        const Configuration<dim> &configuration,
                        const bool                held_in_place)
  {
    mesh                   = &new_mesh;
    bodies                 = &new_bodies;
    preconditioner_instant = Instant();
    prediction.reset();
    motion.reset();
    // the former ones first: together they would take twice the memory
    known_conformation = KnownConformation();
    if (parameters.viscoelastic())
      known_conformation = KnownConformation(*mesh);
    flow_solver.reinit(*mesh, *bodies, configuration, held_in_place);
  }



  template <int dim>
  bool
  FlowStep<dim>::has_numerical_viscosity(const TimeStep &step) const
  {
    return step.has_previous() &&
           StressPrediction<dim>::numerical_viscosity(
             Giesekus<dim>(parameters.fluid.giesekus)) > 0.;
  }



  template <int dim>
  std::unique_ptr<typename FlowStep<dim>::Motion>
  FlowStep<dim>::motion_towards(const Level<dim> &next,
                                const TimeStep   &step,
                                const Level<dim> &now,
                                const VectorType &mesh_velocity) const
  {
    auto    motion    = std::make_unique<Motion>();
    Motion &result    = *motion;
    result.convection = next.flow.velocity;
    result.convection -= mesh_velocity;
    result.convection.update_ghost_values();
    result.last_velocity = now.flow.velocity;
    result.last_velocity.update_ghost_values();
    if (has_numerical_viscosity(step))
      result.smooth_strain_rate =
        StrainRateProjection<dim>(*mesh).project(now.flow.velocity);
    return motion;
  }



  /// References to all but the step are kept.
  template <int dim>
  std::unique_ptr<StressPrediction<dim>>
  FlowStep<dim>::predict(const TimeStep     &step,
                         const Conformation &now,
                         const Conformation &before,
                         const Motion       &motion)
  {
    return std::make_unique<StressPrediction<dim>>(
      *mesh,
      Giesekus<dim>(parameters.fluid.giesekus),
      step,
      now,
      before.logarithm.empty() ? now : before,
      motion,
      known_conformation);
  }



  template <int dim>
  unsigned int
  FlowStep<dim>::solve(Level<dim>                &next,
                       const TimeStep            &step,
                       const Level<dim>          &now,
                       const Level<dim>          &before,
                       const VectorType          &mesh_velocity,
                       const std::vector<double> &external_forces,
                       const Contacts<dim>       &contacts)
  {
    const auto candidates    = contacts.candidates(next.configuration);
    next.flow.contact_forces = contacts.remembered_forces(candidates);
    const unsigned int iterations =
      nonlinear_solver ?
        solve_nonlinear(next, candidates, external_forces) :
        solve_linear(
          next, step, now, before, mesh_velocity, candidates, external_forces);
    count_repeated_solves();
    return iterations;
  }



  /// Those not counted yet; some may be of a solve that failed in the end.
  template <int dim>
  void
  FlowStep<dim>::count_repeated_solves()
  {
    const auto repeated = flow_solver.repeated_solves();
    const auto count    = [&](const std::string &name,
                           const unsigned int now,
                           const unsigned int before) {
      if (now > before)
        run_report.count(name, now - before);
    };
    count("solves repeated with a fresh preconditioner",
          repeated.with_fresh_preconditioner,
          counted.with_fresh_preconditioner);
    count("solves repeated with a stronger preconditioner",
          repeated.with_stronger_preconditioner,
          counted.with_stronger_preconditioner);
    counted = repeated;
  }



  template <int dim>
  unsigned int
  FlowStep<dim>::solve_nonlinear(Level<dim>                      &next,
                                 const std::vector<Contact<dim>> &candidates,
                                 const std::vector<double> &external_forces)
  {
    const auto timer  = run_report.time("flow: solve");
    const auto report = nonlinear_solver->solve(next.configuration,
                                                next.flow,
                                                candidates,
                                                external_forces);
    run_report.count("nonlinear steps of the flow",
                     report.picard_steps + report.newton_steps);
    if (nonlinear_solver->has_new_preconditioner())
      {
        const auto &point      = nonlinear_solver->preconditioner_point();
        preconditioner_instant = Instant();
        preconditioner_instant.configuration = next.configuration;
        preconditioner_instant.positions     = mesh->positions();
        preconditioner_instant.velocity      = point.velocity;
        preconditioner_instant.linearisation = point.form;
      }
    find_reactions(next,
                   CarreauStress<dim>(Carreau(parameters.fluid.carreau),
                                      next.flow.velocity,
                                      Linearisation::picard));
    return report.linear_iterations;
  }



  template <int dim>
  unsigned int
  FlowStep<dim>::solve_linear(Level<dim>                      &next,
                              const TimeStep                  &step,
                              const Level<dim>                &now,
                              const Level<dim>                &before,
                              const VectorType                &mesh_velocity,
                              const std::vector<Contact<dim>> &candidates,
                              const std::vector<double>       &external_forces)
  {
    static const NewtonianStress<dim> newtonian;
    if (parameters.viscoelastic())
      {
        motion = motion_towards(next, step, now, mesh_velocity);
        prediction =
          predict(step,
                  {now.log_conformation, now.unresolved_conformation},
                  {before.log_conformation, before.unresolved_conformation},
                  *motion);
      }
    const StressModel<dim> &stress =
      prediction ? static_cast<const StressModel<dim> &>(*prediction) :
                   newtonian;
    {
      const auto timer = run_report.time("flow: assembly");
      flow_solver.assemble(next.configuration, stress);
    }
    const auto         timer = run_report.time("flow: solve");
    const unsigned int iterations =
      flow_solver.solve(next.flow, candidates, external_forces);
    if (flow_solver.has_fresh_preconditioner())
      preconditioner_instant = {next.configuration,
                                mesh->positions(),
                                step,
                                now.log_conformation,
                                before.log_conformation,
                                VectorType()};
    find_reactions(next, stress);
    return iterations;
  }



  template <int dim>
  void
  FlowStep<dim>::find_unresolved_conformation(Level<dim> &next)
  {
    Assert(prediction, ExcMessage("No flow has been solved for."));
    const auto timer = run_report.time("unresolved conformation");
    prediction->unresolved_conformation(next.flow.velocity,
                                        next.log_conformation,
                                        next.unresolved_conformation);
    prediction.reset();
    motion.reset();
  }



  template <int dim>
  unsigned int
  FlowStep<dim>::balance_stress(State<dim>                &state,
                                const std::vector<double> &forces)
  {
    const auto  timer  = run_report.time("balance of a transferred stress");
    Level<dim> &now    = state.now;
    Level<dim> &before = state.before;
    Configuration<dim> at_rest = now.configuration;
    at_rest.shear_rate         = 0.;
    mesh->set_positions(now.positions);

    const Giesekus<dim>      fluid(parameters.fluid.giesekus);
    const StressBalance<dim> balance(*mesh, fluid, now, before.flow.velocity);
    flow_solver.assemble(at_rest, balance);
    FlowFields<dim> flow          = imposed_flow(*mesh, at_rest, false);
    flow.pressure                 = now.flow.pressure;
    const unsigned int iterations = flow_solver.solve(flow, {}, forces);
    count_repeated_solves();
    // that was for another viscosity
    flow_solver.renew_preconditioner();

    for (PointTensors<dim> *unresolved :
         {&now.unresolved_conformation, &before.unresolved_conformation})
      *unresolved = balance.sum(*unresolved, flow.velocity);
    return iterations;
  }



  /// What holds the particles, if any is held.
  template <int dim>
  void
  FlowStep<dim>::find_reactions(Level<dim>             &level,
                                const StressModel<dim> &stress) const
  {
    if (bodies->any_held())
      level.flow.reactions = particle_forces<dim>(
        *mesh, *bodies, level.configuration, stress, level.flow);
  }



  template <int dim>
  void
  FlowStep<dim>::Instant::archive(FieldArchive<dim> &archive)
  {
    archive(configuration, step.dt, step.previous_dt, linearisation);
    archive.vector(positions);
    archive.scalars(log_conformation);
    archive.scalars(old_log_conformation);
    archive.vector(velocity);
  }



  template <int dim>
  void
  FlowStep<dim>::assemble_preconditioner()
  {
    const Instant &instant = preconditioner_instant;
    mesh->set_positions(instant.positions);
    flow_solver.renew_preconditioner();

    // it depends on the viscosity, which knows of no motion
    const PointTensors<dim> none;
    Motion                  rest;
    rest.convection = rest.last_velocity = mesh->vector_field();
    if (parameters.viscoelastic() && has_numerical_viscosity(instant.step))
      rest.smooth_strain_rate = mesh->tensor_field();

    std::unique_ptr<StressModel<dim>> model;
    if (nonlinear_solver)
      model =
        std::make_unique<CarreauStress<dim>>(Carreau(parameters.fluid.carreau),
                                             instant.velocity,
                                             instant.linearisation);
    else if (!parameters.viscoelastic())
      model = std::make_unique<NewtonianStress<dim>>();
    else
      model = predict(instant.step,
                      {instant.log_conformation, none},
                      {instant.old_log_conformation, none},
                      rest);
    flow_solver.assemble(instant.configuration, *model);
  }



  template <int dim>
  void
  FlowStep<dim>::archive(FieldArchive<dim> &archive)
  {
    Instant &instant = preconditioner_instant;
    if (archive.is_loading())
      instant = Instant();
    instant.archive(archive);
    if (archive.is_loading() && instant.positions.size() > 0)
      {
        const bool complete =
          parameters.viscoelastic() ?
            !instant.log_conformation.empty() :
            !nonlinear_solver || instant.velocity.size() > 0;
        if (!complete)
          throw CheckpointError("what its preconditioner is of is missing");
        assemble_preconditioner();
      }
    flow_solver.archive(archive);
  }



  template class FlowStep<2>;
  template class FlowStep<3>;
} // namespace Catena

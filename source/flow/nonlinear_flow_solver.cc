#include <catena/base/exceptions.h>
#include <catena/base/replace_field.h>
#include <catena/flow/nonlinear_flow_solver.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  void
  NonlinearSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Nonlinear tolerance",
                      tolerance,
                      "Residual of momentum and mass at which the iterations "
                      "on the viscosity end, relative to the right-hand side "
                      "of the disturbance problem.",
                      Patterns::Double());
    prm.add_parameter("Maximal nonlinear iterations",
                      max_iterations,
                      "Iterations on the viscosity after which a solve has "
                      "failed.",
                      Patterns::Integer(0));
  }



  void
  NonlinearSolverParameters::check() const
  {
    require(tolerance >= 1e-12 && tolerance < 1e-2,
            "Flow solver/Nonlinear tolerance",
            tolerance,
            "choose a value between 1e-12 and 1e-2");
    require(max_iterations >= 1 && max_iterations < 100000,
            "Flow solver/Maximal nonlinear iterations",
            max_iterations,
            "choose a positive number, 50 is usual");
  }



  namespace
  {
    /// Picard's method as long as the residual is larger, relative to the
    /// right-hand side
    constexpr double picard_residual = 0.05;

    /// reduction of the residual by a linear solve: of a Picard step; of a
    /// first Newton step, over the relative residual; and the bounds of all
    constexpr double picard_forcing   = 0.1;
    constexpr double first_forcing    = 0.2;
    constexpr double largest_forcing  = 0.1;
    constexpr double smallest_forcing = 1e-6;

    /// smallest part of a Newton step that is tried
    constexpr double smallest_step = 0.1;

    SolverError
    failure(const double                 residual,
            const double                 wanted,
            const NonlinearSolverReport &report)
    {
      std::ostringstream text;
      text << "The nonlinear flow solver reached a residual of " << residual
           << " in " << report.picard_steps << " Picard and "
           << report.newton_steps << " Newton steps, " << wanted
           << " was asked for: raise 'Flow solver/Maximal nonlinear "
              "iterations' or use a smaller time step.";
      return SolverError(text.str());
    }
  } // namespace



  template <int dim>
  NonlinearFlowSolver<dim>::NonlinearFlowSolver(
    FlowSolver<dim>                 &flow_solver,
    const Carreau                   &model,
    const NonlinearSolverParameters &parameters)
    : flow_solver(flow_solver)
    , model(model)
    , parameters(parameters)
  {}



  template <int dim>
  NonlinearSolverReport
  NonlinearFlowSolver<dim>::solve(const Configuration<dim> &configuration,
                                  FlowFields<dim>          &fields,
                                  const std::vector<Contact<dim>> &contacts,
                                  const std::vector<double> &external_forces,
                                  const Function<dim>       *body_force)
  {
    // however this ends
    struct EndOfSteps
    {
      FlowSolver<dim> &flow_solver;

      ~EndOfSteps()
      {
        flow_solver.solve_to(0.);
      }
    } const end_of_steps{flow_solver};

    const Problem problem{configuration, contacts, external_forces, body_force};
    NonlinearSolverReport report;
    Iterate               x;
    x.fields           = fields;
    new_preconditioner = false;
    flow_solver.impose_constraints(configuration, x.fields);
    linearise(problem, x, Linearisation::newton);

    bool   picard_converges = true;
    double before           = 0.; // residual before the last Newton step
    scale                   = 0.;
    while (true)
      {
        const double now = x.residual.norm;
        scale            = std::max(scale, x.residual.right_hand_side);
        report.residuals.push_back(now / scale);
        if (now <= target(x.residual))
          break;
        if (report.residuals.size() > parameters.max_iterations ||
            !std::isfinite(now))
          throw failure(now, target(x.residual), report);

        const double forcing = before > 0. ?
                                 0.9 * (now / before) * (now / before) :
                                 first_forcing * now / scale;
        const bool   far     = now > picard_residual * scale;
        if ((far && picard_converges) ||
            !newton_step(problem, x, forcing, report))
          {
            picard_step(problem, x, report);
            picard_converges = x.residual.norm < now;
            before           = 0.;
          }
        else
          before = now;
      }
    fields = x.fields;
    return report;
  }



  template <int dim>
  double
  NonlinearFlowSolver<dim>::target(const FlowResidual &residual) const
  {
    return std::max(parameters.tolerance * scale, residual.rounding);
  }



  /**
   * Assemble the equations linearised about @p x, and find its residual.
   */
  template <int dim>
  void
  NonlinearFlowSolver<dim>::linearise(const Problem      &problem,
                                      Iterate            &x,
                                      const Linearisation new_form)
  {
    replace_field(linearisation_point, x.fields.velocity);
    form = new_form;
    stress =
      std::make_unique<CarreauStress<dim>>(model, linearisation_point, form);
    flow_solver.assemble(problem.configuration, *stress, problem.body_force);
    note_preconditioner();
    x.residual =
      flow_solver.residual(x.fields, problem.contacts, problem.external_forces);
  }



  template <int dim>
  void
  NonlinearFlowSolver<dim>::note_preconditioner()
  {
    if (!flow_solver.has_fresh_preconditioner())
      return;
    replace_field(point_of_preconditioner.velocity, linearisation_point);
    point_of_preconditioner.form = form;
    new_preconditioner           = true;
  }



  /**
   * Reduce the residual of the linearised equations by the factor @p forcing.
   */
  template <int dim>
  FlowFields<dim>
  NonlinearFlowSolver<dim>::solve_linear(const Problem         &problem,
                                         const Iterate         &x,
                                         const double           forcing,
                                         NonlinearSolverReport &report)
  {
    FlowFields<dim> result = x.fields;
    flow_solver.solve_to(
      std::max(forcing * x.residual.norm, 0.3 * target(x.residual)));
    report.linear_iterations +=
      flow_solver.solve(result, problem.contacts, problem.external_forces);
    note_preconditioner();
    return result;
  }



  /**
   * @return whether a part of the step reduced the residual; else @p x is as
   * before
   */
  template <int dim>
  bool
  NonlinearFlowSolver<dim>::newton_step(const Problem         &problem,
                                        Iterate               &x,
                                        const double           forcing,
                                        NonlinearSolverReport &report)
  {
    FlowFields<dim> end;
    try
      {
        end =
          solve_linear(problem,
                       x,
                       std::clamp(forcing, smallest_forcing, largest_forcing),
                       report);
      }
    catch (const SolverError &)
      {
        return false;
      }
    for (double part = 1.; part >= smallest_step; part /= 2.)
      {
        Iterate trial;
        trial.fields = combination(part, end, 1. - part, x.fields);
        linearise(problem, trial, Linearisation::newton);
        if (trial.residual.norm <= (1. - 0.1 * part) * x.residual.norm)
          {
            x = std::move(trial);
            ++report.newton_steps;
            return true;
          }
      }
    return false;
  }



  template <int dim>
  void
  NonlinearFlowSolver<dim>::picard_step(const Problem         &problem,
                                        Iterate               &x,
                                        NonlinearSolverReport &report)
  {
    // the viscosity has changed much
    flow_solver.renew_preconditioner();
    linearise(problem, x, Linearisation::picard);
    x.fields = solve_linear(problem, x, picard_forcing, report);
    linearise(problem, x, Linearisation::newton);
    ++report.picard_steps;
  }



  template class NonlinearFlowSolver<2>;
  template class NonlinearFlowSolver<3>;
} // namespace Catena

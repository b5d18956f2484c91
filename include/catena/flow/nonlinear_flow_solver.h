#ifndef catena_flow_nonlinear_flow_solver_h
#define catena_flow_nonlinear_flow_solver_h

#include <catena/flow/carreau_stress.h>
#include <catena/flow/flow_solver.h>
#include <catena/rheology/carreau.h>

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Controls of the nonlinear solver of momentum and mass.
   */
  struct NonlinearSolverParameters
  {
    /// residual against the right-hand side of the disturbance problem, the
    /// largest of the iterations
    double       tolerance      = 1e-6;
    unsigned int max_iterations = 50;

    /**
     * Declare the entries "Nonlinear tolerance" and "Maximal nonlinear
     * iterations" in the current section of @p prm.
     */
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * What a nonlinear solve did.
   */
  struct NonlinearSolverReport
  {
    unsigned int picard_steps      = 0;
    unsigned int newton_steps      = 0;
    unsigned int linear_iterations = 0;
    /// relative: at the first guess and after every step
    std::vector<double> residuals;
  };



  /**
   * Solves the flow of a Carreau fluid and the motions of the particles in it.
   * Far from the solution the viscosity is frozen from step to step (Picard),
   * which converges from any first guess for a shear-thinning fluid; close to
   * it Newton's method takes over, with the residual's norm as measure of a
   * line search, and back to a Picard step where that fails. The linear
   * problems are solved as far as their own error allows (Eisenstat & Walker,
   * SIAM J. Sci. Comput. 17 (1996) 16, choice 2).
   */
  template <int dim>
  class NonlinearFlowSolver
  {
  public:
    /**
     * @param flow_solver solves the linear problems; kept by reference, its
     * mesh and particles are those of the nonlinear problem
     */
    NonlinearFlowSolver(FlowSolver<dim>                 &flow_solver,
                        const Carreau                   &model,
                        const NonlinearSolverParameters &parameters);

    /**
     * Solve with @p fields as first guess; arguments as those of FlowSolver.
     *
     * @throws SolverError if it does not converge in the maximal number of
     * iterations
     */
    NonlinearSolverReport
    solve(const Configuration<dim>        &configuration,
          FlowFields<dim>                 &fields,
          const std::vector<Contact<dim>> &contacts,
          const std::vector<double>       &external_forces,
          const dealii::Function<dim>     *body_force = nullptr);

    /// The velocity about which the equations were linearised of which the
    /// preconditioner was made, and how.
    struct LinearisationPoint
    {
      VectorType    velocity;
      Linearisation form = Linearisation::picard;
    };

    const LinearisationPoint &
    preconditioner_point() const
    {
      return point_of_preconditioner;
    }

    /// Was the preconditioner made anew in the last solve?
    bool
    has_new_preconditioner() const
    {
      return new_preconditioner;
    }

  private:
    /// What does not change during a solve.
    struct Problem
    {
      const Configuration<dim>        &configuration;
      const std::vector<Contact<dim>> &contacts;
      const std::vector<double>       &external_forces;
      const dealii::Function<dim>     *body_force;
    };

    /// An iterate, and the residual there.
    struct Iterate
    {
      FlowFields<dim> fields;
      FlowResidual    residual;
    };

    FlowSolver<dim>                &flow_solver;
    const Carreau                   model;
    const NonlinearSolverParameters parameters;

    VectorType                          linearisation_point;
    std::unique_ptr<CarreauStress<dim>> stress;
    Linearisation                       form  = Linearisation::picard;
    double                              scale = 0.;
    LinearisationPoint                  point_of_preconditioner;
    bool                                new_preconditioner = false;

    void
    note_preconditioner();

    double
    target(const FlowResidual &residual) const;

    void
    linearise(const Problem &problem, Iterate &x, const Linearisation form);

    FlowFields<dim>
    solve_linear(const Problem         &problem,
                 const Iterate         &x,
                 const double           forcing,
                 NonlinearSolverReport &report);

    bool
    newton_step(const Problem         &problem,
                Iterate               &x,
                const double           forcing,
                NonlinearSolverReport &report);

    void
    picard_step(const Problem         &problem,
                Iterate               &x,
                NonlinearSolverReport &report);
  };
} // namespace Catena

#endif

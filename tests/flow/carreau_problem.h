#ifndef catena_tests_flow_carreau_problem_h
#define catena_tests_flow_carreau_problem_h

#include <catena/flow/nonlinear_flow_solver.h>

#include <string>
#include <vector>

#include "../print.h"
#include "stokes_problem.h"

namespace Catena
{
  namespace Tests
  {
    inline Carreau
    carreau(const double power_index, const double carreau_time)
    {
      CarreauParameters parameters;
      parameters.power_index  = power_index;
      parameters.carreau_time = carreau_time;
      return Carreau(parameters);
    }



    /**
     * A scene meshed and its flow in a Carreau fluid at one instant.
     */
    template <int dim>
    class CarreauProblem : public StokesProblem<dim>
    {
    public:
      CarreauProblem(const Scene<dim>     &scene,
                     const MeshParameters &mesh_parameters,
                     const double          tolerance = 1e-10)
        : StokesProblem<dim>(scene, mesh_parameters, tolerance)
        , tolerance(tolerance)
      {}

      using StokesProblem<dim>::solve;

      /**
       * Solve for free particles with the present fields as first guess, and
       * print what the solver did.
       */
      NonlinearSolverReport
      solve(const Carreau                   &model,
            const std::vector<Contact<dim>> &contacts   = {},
            const dealii::Function<dim>     *body_force = nullptr)
      {
        NonlinearSolverParameters parameters;
        parameters.tolerance = tolerance;
        NonlinearFlowSolver<dim> nonlinear(this->solver, model, parameters);

        const auto report =
          nonlinear.solve(this->configuration,
                          this->fields,
                          contacts,
                          std::vector<double>(this->bodies.n_unknowns(), 0.),
                          body_force);
        print(this->mesh.n_global_cells(),
              " cells, ",
              report.picard_steps,
              " Picard and ",
              report.newton_steps,
              " Newton steps, ",
              report.linear_iterations,
              " linear iterations; residuals:");
        for (const double residual : report.residuals)
          print("  ", residual);
        return report;
      }

    private:
      const double tolerance;
    };
  } // namespace Tests
} // namespace Catena

#endif

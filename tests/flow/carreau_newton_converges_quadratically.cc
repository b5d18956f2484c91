// Three discs, the outer ones at the smallest gap, in a Carreau fluid with
// n = 0.3 and lambda_c = 10. With linear problems solved to the end the
// residuals of Newton's method fall quadratically; those of the solver, which
// stops its linear problems early, with an order well above 1. With too few
// steps it says so.

#include <catena/base/exceptions.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "carreau_problem.h"

using namespace Catena;

/// Order p of the last steps above rounding, in the mean of @p n_steps: they
/// multiply the decades that a step gains by p each.
double
last_order(const std::vector<double> &residuals, const unsigned int n_steps)
{
  unsigned int n = residuals.size();
  AssertThrow(n >= n_steps + 2, dealii::ExcInternalError());
  while (n > n_steps + 2 && residuals[n - 1] < 1e-10)
    --n;
  const auto gain = [&](const unsigned int step) {
    return std::log(residuals[step] / residuals[step - 1]);
  };
  return std::pow(gain(n - 1) / gain(n - 1 - n_steps), 1. / n_steps);
}



/// The largest r_(k+1)/r_k^2 above rounding.
double
quadratic_constant(const std::vector<double> &residuals)
{
  double result = 0.;
  for (unsigned int k = 1; k < residuals.size(); ++k)
    if (residuals[k] > 1e-12)
      result =
        std::max(result, residuals[k] / (residuals[k - 1] * residuals[k - 1]));
  return result;
}



/// Exact Newton steps from a solution whose motion of the fluid is disturbed.
std::vector<double>
newton(const Carreau &model, Tests::CarreauProblem<2> &problem)
{
  for (const auto node : problem.mesh.owned_nodes())
    {
      const auto x = problem.position(node);
      problem.fields.velocity(2 * node) +=
        0.003 * std::sin(3. * x[0]) * std::sin(2. * x[1]);
    }
  problem.solver.impose_constraints(problem.configuration, problem.fields);

  const std::vector<double> no_forces(problem.bodies.n_unknowns(), 0.);
  std::vector<double>       residuals;
  double                    scale = 0.;
  for (unsigned int step = 0; step < 6; ++step)
    {
      const VectorType       point = problem.fields.velocity;
      const CarreauStress<2> stress(model, point, Linearisation::newton);
      problem.solver.assemble(problem.configuration, stress);
      const FlowResidual residual =
        problem.solver.residual(problem.fields, {}, no_forces);
      scale = std::max(scale, residual.right_hand_side);
      residuals.push_back(residual.norm / scale);
      Tests::print("  exact steps: ", residuals.back());
      problem.solver.solve_to(
        std::max(1e-8 * residual.norm, residual.rounding));
      problem.solver.solve(problem.fields, {}, no_forces);
    }
  problem.solver.solve_to(0.);
  return residuals;
}



/// The sentence with which the solver gives up after two steps from rest.
std::string
failure(const Carreau &model, Tests::CarreauProblem<2> &problem)
{
  NonlinearSolverParameters parameters;
  parameters.max_iterations = 2;
  NonlinearFlowSolver<2> solver(problem.solver, model, parameters);
  FlowFields<2>          fields = problem.fields;
  fields.velocity               = 0.;
  try
    {
      solver.solve(problem.configuration,
                   fields,
                   {},
                   std::vector<double>(problem.bodies.n_unknowns(), 0.));
    }
  catch (const SolverError &error)
    {
      return error.what();
    }
  return "";
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const Carreau model = Tests::carreau(0.3, 10.);

    Tests::CarreauProblem<2> problem(Tests::three_particles<2>(),
                                     Tests::resolution(48, 2),
                                     1e-11);
    const auto               report = problem.solve(model);
    claims.at_most("a cold start needs few steps",
                   report.picard_steps + report.newton_steps,
                   14);
    // what one step stops early of its linear problem is left to the next
    claims.at_least("order of the solver's last steps",
                    last_order(report.residuals, 2),
                    1.4);

    const auto motions   = problem.fields.motions;
    const auto residuals = newton(model, problem);
    claims.at_least("order of the last exact steps",
                    last_order(residuals, 1),
                    1.7);
    claims.at_most("exact steps square the residual, times",
                   quadratic_constant(residuals),
                   200.);
    claims.at_most("residual of exact steps", residuals.back(), 1e-11);
    claims.at_most(
      "they find the same motion",
      (problem.fields.motions[1].velocity - motions[1].velocity).norm(),
      1e-9);

    const std::string sentence = failure(model, problem);
    Tests::print(sentence);
    claims.holds("two steps are too few from rest",
                 sentence.find("Maximal nonlinear iterations") !=
                   std::string::npos);
  });
}

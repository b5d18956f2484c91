#include <catena/flow/flow_operator.h>
#include <catena/flow/refined_gmres.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector_memory.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// by one solution in single precision: of the residual, and what a useful
    /// one gives at least
    constexpr double largest_reduction = 1e-6, smallest_progress = 0.5;
  } // namespace



  template <int dim>
  RefinedGmres<dim>::RefinedGmres(const FlowSystem<dim>         &system,
                                  const ContactBlocks           &contacts,
                                  const FlowPreconditioner<dim> &preconditioner)
    : system(system)
    , contacts(contacts)
    , preconditioner(preconditioner)
  {}



  /**
   * A strong preconditioner is another one in each iteration, so that GMRES has
   * to keep what it gave; of the usual one it does not: that is half of the
   * memory, and one application more.
   */
  template <int dim>
  typename RefinedGmres<dim>::Correction
  RefinedGmres<dim>::correction_of(const BlockVectorType &residual,
                                   const double           wanted,
                                   const unsigned int     max_iterations) const
  {
    using Flexible = SolverFGMRES<FastBlockVectorType>;
    using Usual    = SolverGMRES<FastBlockVectorType>;
    const FlowOperator<dim, float> fast_system{system, contacts};

    FastBlockVectorType fast_residual;
    fast_residual = residual;
    Correction result;
    result.values.reinit(fast_residual);
    SolverControl control(std::min(max_iterations, basis_size), wanted);
    try
      {
        // of the vectors deal.II uses one and two for other things
        if (preconditioner.is_strong())
          Flexible(control, typename Flexible::AdditionalData(basis_size + 1))
            .solve(fast_system, result.values, fast_residual, preconditioner);
        else
          Usual(control, typename Usual::AdditionalData(basis_size + 2, true))
            .solve(fast_system, result.values, fast_residual, preconditioner);
        result.has_converged = true;
      }
    catch (const SolverControl::NoConvergence &)
      {
        // what the basis gives is a correction nevertheless
        result.has_converged = false;
      }
    GrowingVectorMemory<FastBlockVectorType>::release_unused_memory();
    result.iterations = control.last_step();
    return result;
  }



  template <int dim>
  typename RefinedGmres<dim>::Result
  RefinedGmres<dim>::solve(BlockVectorType       &solution,
                           const BlockVectorType &rhs,
                           const double           wanted,
                           const unsigned int     max_iterations) const
  {
    const FlowOperator<dim, double> whole_system{system, contacts};
    BlockVectorType                 residual(rhs), correction(rhs);
    const auto                      find_residual = [&]() {
      whole_system.vmult(residual, solution);
      residual.sadd(-1., 1., rhs);
      return residual.l2_norm();
    };

    Result       result;
    double       norm       = find_residual();
    const double first_norm = norm;
    while (!(norm <= wanted))
      {
        // of length one, far from the limits of single precision
        residual *= 1. / norm;
        const Correction found =
          correction_of(residual,
                        std::max(single_precision_share * wanted / norm,
                                 largest_reduction),
                        max_iterations - result.iterations);
        result.iterations += found.iterations;
        correction = found.values;
        solution.add(norm, correction);
        const double last_norm = std::exchange(norm, find_residual());
        // little is left to be gained near the end
        const bool   near_end = last_norm < wanted / smallest_progress;
        const double enough =
          near_end || !found.has_converged ? 1. : smallest_progress;
        if (!(norm <= wanted) && (result.iterations >= max_iterations ||
                                  !(norm < enough * last_norm)))
          throw SolverControl::NoConvergence(result.iterations, norm);
      }
    result.decades = std::log10(first_norm / norm);
    return result;
  }



  template class RefinedGmres<2>;
  template class RefinedGmres<3>;
} // namespace Catena

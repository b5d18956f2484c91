#ifndef catena_flow_refined_gmres_h
#define catena_flow_refined_gmres_h

#include <catena/flow/flow_preconditioner.h>
#include <catena/flow/flow_system.h>

namespace Catena
{
  /**
   * Solves the equations of FlowSystem with contacts by iterative refinement:
   * GMRES in single precision, preconditioned from the right, gives corrections
   * of the residual in double precision as long as that asks for one.
   */
  template <int dim>
  class RefinedGmres
  {
  public:
    /// Iterations after which the residual is found anew, in double precision:
    /// a longer basis saves few, and takes a vector and more products for each.
    static constexpr unsigned int basis_size = 20;

    /// Of the wanted residual, what single precision is to aim at.
    static constexpr double single_precision_share = 0.9;

    /**
     * References are kept.
     * @param preconditioner knows the contacts
     */
    RefinedGmres(const FlowSystem<dim>         &system,
                 const ContactBlocks           &contacts,
                 const FlowPreconditioner<dim> &preconditioner);

    struct Result
    {
      unsigned int iterations = 0;
      /// of the residual, from that of the first guess
      double decades = 0.;
    };

    /**
     * @param solution the first guess, and what is found
     * @param wanted norm of the residual
     * @throws dealii::SolverControl::NoConvergence if it is not reached in so
     * many iterations, or comes no nearer
     */
    Result
    solve(BlockVectorType       &solution,
          const BlockVectorType &rhs,
          const double           wanted,
          const unsigned int     max_iterations) const;

  private:
    const FlowSystem<dim>         &system;
    const ContactBlocks           &contacts;
    const FlowPreconditioner<dim> &preconditioner;

    /// What GMRES finds for a residual of length one.
    struct Correction
    {
      FastBlockVectorType values;
      unsigned int        iterations;
      bool                has_converged;
    };

    Correction
    correction_of(const BlockVectorType &residual,
                  const double           wanted,
                  const unsigned int     max_iterations) const;
  };
} // namespace Catena

#endif

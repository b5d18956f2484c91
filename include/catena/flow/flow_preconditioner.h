#ifndef catena_flow_flow_preconditioner_h
#define catena_flow_flow_preconditioner_h

#include <catena/flow/flow_system.h>
#include <catena/flow/preconditioner_matrices.h>
#include <catena/flow/sparse_products.h>
#include <catena/flow/velocity_multigrid.h>
#include <catena/particles/acting_contacts.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Block upper triangular preconditioner of FlowSystem with contacts,
   *
   *   [ A    B^T  C ] [u']   [f]
   *   [ B    0    D ] [p ] = [g]
   *   [ R    D^T  S ] [r ]   [h]:
   *
   *   p = -2.5 M^-1 g,   (u, r, F_r) = K^-1 (f - 0.8 B^T p, h - D^T p, ...),
   *
   * with M the pressure mass matrix scaled by the fluidity (three Chebyshev
   * sweeps). Of a gradient, the velocity block A is twice the viscous operator
   * of a component, int (L H + H L^T) : grad v = 2 int L H : grad v, which is
   * why B A^-1 B^T is nearer to M / 2 than to M. K^-1 is one cycle of
   * VelocityMultigrid on the scalar operator of the velocity components, which
   * includes the tensor viscosity; it takes gradients for half of what they are
   * in A, which is why not all of the pressure acts on them. (Both factors are
   * those with the fewest iterations: 0.8 times 2.5 is the 2 of M / 2.) The
   * rigid-body unknowns, whose rows are too dense for multigrid, and the
   * contact forces are eliminated by their small Schur complement, with the
   * response of the velocity to each motion by some steps of GMRES on A. A
   * strengthened one takes such steps for the velocity, too, each with that
   * cycle, and all of the pressure, where the components are coupled too much
   * for the cycle alone.
   *
   * It is made of one instant and can be kept for many steps; only those steps
   * of GMRES take A as it is now.
   */
  template <int dim>
  class FlowPreconditioner
  {
  public:
    /// Give the memory free until initialize().
    void
    clear();

    /// Set up from what was assembled last, not strengthened. System and
    /// matrices are kept by reference until clear().
    void
    initialize(const MovingMesh<dim>                &mesh,
               const std::vector<NodeCoupling<dim>> &couplings,
               const FlowSystem<dim>                &system,
               const PreconditionerMatrices<dim>    &matrices);

    /// Take over the contacts; cheap.
    void
    set_contacts(const ContactBlocks &contacts);

    /// Nearer to the inverse until initialize(), several times dearer.
    void
    strengthen()
    {
      strong = true;
    }

    bool
    is_strong() const
    {
      return strong;
    }

    void
    vmult(FastBlockVectorType &dst, const FastBlockVectorType &src) const;

    /// Cost of initialize(), in iterations of the solver, roughly.
    unsigned int
    set_up_cost() const;

    /// Resistance of the particles to their motion, roughly.
    const dealii::FullMatrix<double> &
    rigid_resistance() const
    {
      return rigid_schur;
    }

  private:
    using MassInverse =
      dealii::PreconditionChebyshev<BlockMatrix<1>,
                                    FastVectorType,
                                    dealii::DiagonalMatrix<FastVectorType>>;

    const FlowSystem<dim>             *system   = nullptr;
    const PreconditionerMatrices<dim> *matrices = nullptr;
    VelocityMultigrid<dim>             multigrid;
    MassInverse                        mass_inverse;
    bool                               strong = false;

    /// R and D^T, the rows of the rigid-body unknowns
    SparseProducts velocity_reactions, pressure_reactions;
    /// A^-1 C, approximately, and the Schur complement S - R A^-1 C
    std::vector<FastVectorType> rigid_responses;
    dealii::FullMatrix<double>  rigid_schur, small_inverse;

    mutable FastVectorType velocity_src;

    /// dst = A^-1 src, approximately
    void
    solve_velocity(FastVectorType       &dst,
                   const FastVectorType &src,
                   const unsigned int    steps) const;

    void
    initialize_mass();

    void
    initialize_rigid();
  };

} // namespace Catena

#endif

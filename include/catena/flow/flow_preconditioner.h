#ifndef catena_flow_flow_preconditioner_h
#define catena_flow_flow_preconditioner_h

#include <catena/flow/flow_system.h>
#include <catena/flow/gap_pressures.h>
#include <catena/flow/preconditioner_matrices.h>
#include <catena/flow/sparse_vectors.h>
#include <catena/flow/velocity_multigrid.h>
#include <catena/particles/acting_contacts.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/vector.h>

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
   * rigid-body unknowns, whose rows are too dense for multigrid, the pressures
   * of narrow gaps, for which M says little (GapPressures; the sum over them is
   * added to p), and the contact forces are eliminated by their small Schur
   * complement, with the response of the velocity to a motion by some steps of
   * GMRES on A, to a pressure by a cycle of multigrid. A strengthened one takes
   * such steps for the velocity, too, each with that cycle, and all of the
   * pressure, where the components are coupled too much for the cycle alone.
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
               const PreconditionerMatrices<dim>    &matrices,
               const Configuration<dim>             &configuration);

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
    dealii::FullMatrix<double>
    rigid_resistance() const;

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

    GapPressures<dim> gap_pressures;

    /// The rows of the rigid-body unknowns and gap pressures: for velocities,
    /// and of the former for pressures.
    SparseVectors velocity_rows, pressure_rows;
    /// A^-1 times their columns, approximately, and their Schur complement.
    std::vector<FastVectorType> responses;
    dealii::FullMatrix<double>  schur;
    /// With the contact forces.
    dealii::FullMatrix<double> small_inverse;

    mutable FastVectorType velocity_src, pressure_src;

    /// dst = A^-1 src, approximately
    void
    solve_velocity(FastVectorType       &dst,
                   const FastVectorType &src,
                   const unsigned int    steps) const;

    void
    initialize_mass();

    void
    initialize_responses();

    void
    subtract_responses(FastVectorType               &velocity,
                       const dealii::Vector<double> &factors) const;
  };

} // namespace Catena

#endif

#ifndef catena_flow_flow_matrices_h
#define catena_flow_flow_matrices_h

#include <catena/base/csr_access.h>
#include <catena/base/types.h>
#include <catena/flow/block_matrix.h>
#include <catena/flow/node_couplings.h>
#include <catena/flow/rigid_product.h>
#include <catena/particles/rigid_bodies.h>

#include <deal.II/base/index_set.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Matrices and right-hand side of the balance of momentum and mass for the
   * disturbance velocity u', the pressure p and the rigid-body unknowns r:
   *
   *   int (L' H + H L'^T) : grad v - p div v  =
   *                         F.v_r - int (L_0 H + H L_0^T + T) : grad v,
   *   -int q div u' = 0,
   *
   * with L_0 the gradient of the imposed flow and v = v_r the rigid motion on
   * particles (constraints of velocity_constraints() condensed).
   *
   * In a pressure-driven scene the pressure is p - P x/L, with p periodic and
   * P the fall of pressure along a period L, which does the work of the flow
   * rate Q through the section of the channel (its mean velocity is 1). P is
   * the last of the unknowns r:
   *
   *   right-hand side of the momentum:  + P/L (int v_x + sum_i V_i v_r,i,x),
   *   -1/L (int u_x + sum_i V_i U_i,x) = -Q,
   *
   * with V_i the volumes of the particles, in which the pressure acts as well.
   *
   * Block by block,
   *
   *   [ A    B^T  C ] [u']   [f]
   *   [ B    0    D ] [p ] = [g]
   *   [ R    D^T  S ] [r ]   [h].
   *
   * FlowAssembly fills them.
   */
  template <int dim>
  class FlowMatrices
  {
  public:
    /**
     * Make sparsity patterns; valid as long as the mesh and which unknowns
     * are constrained do not change.
     */
    FlowMatrices(const MovingMesh<dim>                &mesh,
                 const RigidBodies<dim>               &bodies,
                 const std::vector<NodeCoupling<dim>> &couplings);

    /// Set all to zero; component_matrices and pressure_mass only if asked.
    void
    clear(const bool with_preconditioner);

    /// Take over what A, B^T and B are now into those in single precision.
    void
    update_single_precision();

    /// Number of unknowns r: the rigid-body unknowns, then P if there is one.
    unsigned int
    n_rigid() const
    {
      return rigid_rigid.m();
    }

    /// A, B^T, B, and the same in single precision.
    BlockMatrix<dim, dim, double> velocity;
    BlockMatrix<dim, 1, double>   gradient;
    BlockMatrix<1, dim, double>   divergence;
    BlockMatrix<dim, dim, float>  fast_velocity;
    BlockMatrix<dim, 1, float>    fast_gradient;
    BlockMatrix<1, dim, float>    fast_divergence;

    /// C, R^T, D, S.
    dealii::TrilinosWrappers::SparseMatrix velocity_rigid,
      rigid_velocity_transposed, pressure_rigid;
    dealii::FullMatrix<double> rigid_rigid;
    RigidProduct               velocity_rigid_product, rigid_velocity_product,
      pressure_rigid_product;

    /// Right-hand sides f, g; h is the same on every rank.
    VectorType          velocity_rhs, pressure_rhs;
    std::vector<double> rigid_rhs;

    /// int p q / viscosity, the Schur complement's approximation, and int q.
    dealii::TrilinosWrappers::SparseMatrix pressure_mass;
    VectorType                             vertex_volumes;

    /**
     * Scalar operators int grad v . (H grad u) on the nodes, one for each
     * group of velocity components. In a group the factors of a node are the
     * same, but for components that have no unknown there: the operator of
     * such a component is the group's without the rows and columns of these
     * nodes.
     */
    struct ComponentMatrix
    {
      std::vector<unsigned int> components;
      /// with the pattern of A
      BlockMatrix<1, 1, double> matrix;
    };
    std::vector<ComponentMatrix> component_matrices;

    /// Where the entries of the other sparse blocks are stored.
    CsrAccess velocity_rigid_access, rigid_velocity_access,
      pressure_rigid_access, mass_access;

    /**
     * Which blocks of their rows are those of a cell's node pairs, found once
     * for each pattern.
     */
    struct Offsets
    {
      static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
      static constexpr unsigned int n_vertices = n_linear_nodes(dim);

      std::array<std::array<unsigned short, n_nodes>, n_nodes>    velocity;
      std::array<std::array<unsigned short, n_nodes>, n_vertices> divergence;
      std::array<std::array<unsigned short, n_nodes>, n_vertices> gradient;
    };
    /// by cell of the mesh
    std::vector<Offsets> offsets;

  private:
    const MovingMesh<dim>  &mesh;
    const RigidBodies<dim> &bodies;
    dealii::IndexSet        rigid_owned, rigid_relevant;

    void
    find_offsets(const std::vector<NodeCoupling<dim>> &couplings);

    void
    make_patterns(const std::vector<NodeCoupling<dim>> &couplings);

    bool
    share_operator(const std::vector<unsigned int>      &components,
                   const unsigned int                    component,
                   const std::vector<NodeCoupling<dim>> &couplings) const;

    void
    make_component_matrices(const std::vector<NodeCoupling<dim>> &couplings);
  };
} // namespace Catena

#endif

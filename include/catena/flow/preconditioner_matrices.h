#ifndef catena_flow_preconditioner_matrices_h
#define catena_flow_preconditioner_matrices_h

#include <catena/flow/block_matrix.h>
#include <catena/flow/flow_element.h>
#include <catena/flow/node_couplings.h>
#include <catena/flow/node_matrix.h>
#include <catena/mesh/moving_mesh.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * The matrices that the preconditioner of FlowSystem is made of, where nodes
   * are coupled as NodeCoupling tells. They are assembled when a new one is
   * due, by the ranks that own their rows.
   */
  template <int dim>
  class PreconditionerMatrices
  {
  public:
    /**
     * Make sparsity patterns; valid as long as the mesh and which unknowns
     * are constrained do not change.
     * @param couplings kept by reference
     */
    PreconditionerMatrices(const MovingMesh<dim>                &mesh,
                           const std::vector<NodeCoupling<dim>> &couplings);

    /// Begin anew.
    void
    clear();

    /// What a cell adds, by its number in the mesh's list.
    void
    add(const unsigned int cell, const PreconditionerElement<dim> &element);

    /// Unit equations for what is not solved for.
    void
    finish();

    /// The component matrices are not needed any more.
    void
    release_components();

    /// B^T: pressures act on the nodes.
    BlockMatrix<dim> gradient;

    /// int p q / viscosity, the Schur complement's approximation.
    BlockMatrix<1> pressure_mass;

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
      /// by pair of nodes in the pattern
      std::vector<float> entries;
    };
    std::vector<ComponentMatrix> component_matrices;

    /// The pairs of nodes of the component matrices.
    const BlockPattern &
    node_pairs() const
    {
      return *node_pattern;
    }

    /// The operator of a group, whose entries stay where they are.
    NodeRows
    rows(const ComponentMatrix &group) const
    {
      return {node_pattern->row_starts(),
              node_pattern->local_columns(),
              group.entries.data(),
              node_pattern->column_nodes()};
    }

  private:
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    const MovingMesh<dim>                &mesh;
    const std::vector<NodeCoupling<dim>> &couplings;
    std::shared_ptr<const BlockPattern>   node_pattern;

    void
    make_patterns();

    void
    group_components();

    bool
    share_operator(const std::vector<unsigned int> &components,
                   const unsigned int               component) const;
  };
} // namespace Catena

#endif

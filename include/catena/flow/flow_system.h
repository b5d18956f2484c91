#ifndef catena_flow_flow_system_h
#define catena_flow_flow_system_h

#include <catena/base/types.h>
#include <catena/flow/flow_cells.h>
#include <catena/flow/node_couplings.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/particles/rigid_bodies.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <array>
#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Left and right-hand side of the balance of momentum and mass for the
   * disturbance velocity u', the pressure p and the rigid-body unknowns r:
   *
   *   int (L' H + H L'^T + k (B:L') B) : grad v - p div v  =
   *         F.v_r - int (L_0 H + H L_0^T + k (B:L_0) B + T) : grad v,
   *   -int q div u' = 0,
   *
   * with the coefficients of StressCoefficients, L_0 the gradient of the
   * imposed flow and v = v_r the rigid motion on particles (constraints of
   * velocity_constraints() condensed).
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
   * There is no matrix: a product gives the nodes of the cells the velocities
   * that the unknowns stand for, integrates over the cells (FlowCells), and
   * takes the sums at the nodes back to the unknowns. assemble_flow() sets what
   * is needed for it.
   */
  template <int dim>
  class FlowSystem
  {
  public:
    /// By node, its velocity and pressure.
    template <typename Number>
    using NodeField = dealii::LinearAlgebra::distributed::Vector<Number>;

    /**
     * Valid as long as the mesh and which unknowns are constrained do not
     * change.
     * @param couplings kept by reference; products follow them as they are at
     * set_right_hand_side()
     */
    FlowSystem(const MovingMesh<dim>                &mesh,
               const RigidBodies<dim>               &bodies,
               const std::vector<NodeCoupling<dim>> &couplings);

    /// Number of unknowns r: the rigid-body unknowns, then P if there is one.
    unsigned int
    n_rigid() const
    {
      return rigid_rhs.size();
    }

    /// Those of the nodes of NodeField.
    const dealii::Utilities::MPI::Partitioner &
    nodes() const
    {
      return node_partitioner;
    }

    /// Zero, with ghosts.
    NodeField<double>
    node_field() const
    {
      return NodeField<double>(layout);
    }

    const MovingMesh<dim> &mesh;

    /// What is known of the cells.
    FlowCells<dim> cells;
    /// By local node, the part of this rank of int v_x; pressure-driven only.
    std::vector<double> node_volumes;
    /// int q.
    VectorType vertex_volumes;

    /// Right-hand sides; that of r is the same on every rank.
    VectorType          velocity_rhs, pressure_rhs;
    std::vector<double> rigid_rhs;

    /// A vector of unknowns (u', p, r), r the same on every rank.
    template <typename Vector>
    struct Unknowns
    {
      const Vector              &velocity, &pressure;
      const std::vector<double> &motions;
    };

    /// One of the same kind that is written to.
    template <typename Vector>
    struct Equations
    {
      Vector              &velocity, &pressure;
      std::vector<double> &motions;
    };

    /**
     * dst = A src, with sums over the cells in the precision of @p Number. The
     * equation of a velocity or motion that is not solved for is that it is its
     * own value; that of the pressure at an identified vertex is zero.
     */
    template <typename Number, typename Vector>
    void
    vmult(const Equations<Vector> &dst, const Unknowns<Vector> &src) const;

    /// dst = A^T src in single precision.
    void
    Tvmult(const Equations<FastVectorType> &dst,
           const Unknowns<FastVectorType>  &src) const;

    /**
     * Right-hand sides from @p forces, which the cells of this rank add at
     * their nodes, less what the known velocities take. All cells are set, and
     * products follow them and the couplings as they are now. The forces are
     * not the same afterwards.
     */
    void
    set_right_hand_side(NodeField<double> &forces);

    /// What rounding leaves at most of the forces at the nodes of a flow with
    /// @p velocity, as the norm of all.
    double
    rounding(const VectorType &velocity) const;

  private:
    /// A node whose velocity is not simply an unknown: what NodeCoupling tells
    /// of it, by local numbers and without what is known. Its motions in
    /// node_motions begin where those of the node before end.
    struct CoupledNode
    {
      unsigned int            local, master;
      std::array<double, dim> factors;
      unsigned int            end_of_motions;
    };


    /// A vertex whose pressure is that of another, by their local nodes.
    struct IdentifiedVertex
    {
      unsigned int local, master;
    };

    /// What the nodes of the cells are given for a product, and what they get.
    template <typename Number>
    struct NodeFields
    {
      NodeField<Number> given, sums;
    };

    const RigidBodies<dim>               &bodies;
    const std::vector<NodeCoupling<dim>> &couplings;

    dealii::Utilities::MPI::Partitioner node_partitioner;
    /// of the numbers of the nodes
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    /// local nodes of the owned vertices
    std::vector<unsigned int>     vertex_nodes;
    std::vector<CoupledNode>      coupled_nodes;
    std::vector<NodeMotion>       node_motions;
    bool                          has_coupled_nodes = false;
    std::vector<IdentifiedVertex> identified_vertices;

    mutable NodeFields<double> fields;
    mutable NodeFields<float>  fast_fields;

    dealii::IndexSet
    nodes_of_owned_cells() const;

    void
    collect_coupled_nodes();

    template <typename Number, typename Vector>
    void
    give_nodes(NodeField<Number>      &field,
               const Unknowns<Vector> &unknowns) const;

    template <typename Number, typename Vector>
    void
    take_from_nodes(NodeField<Number>       &field,
                    const Equations<Vector> &equations) const;

    template <typename Number>
    void
    add_pressure_drop(NodeFields<Number>        &fields,
                      std::vector<double>       &rates,
                      const std::vector<double> &motions) const;

    template <typename Vector>
    void
    keep_what_is_known(const Equations<Vector> &dst,
                       const Unknowns<Vector>  &src) const;

    template <typename Number, typename Vector, typename AddCells>
    void
    multiply(NodeFields<Number>      &fields,
             const Equations<Vector> &dst,
             const Unknowns<Vector>  &src,
             const AddCells          &add_cells) const;
  };
} // namespace Catena

#endif

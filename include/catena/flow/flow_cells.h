#ifndef catena_flow_flow_cells_h
#define catena_flow_flow_cells_h

#include <catena/flow/stress_model.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/partitioner.h>

#include <vector>

namespace Catena
{
  /// Numbers of a node: the components of its velocity, then its pressure, if
  /// it is a vertex.
  constexpr unsigned int n_node_numbers = 4;

  /// Cells that are computed at once, side by side.
  constexpr unsigned int cells_at_once = 16;



  /**
   * The balance of momentum and mass as sums over the cells of this rank,
   * without a matrix: for velocities and pressures at the nodes,
   *
   *   int (L H + H L^T + k (B:L) B - p I) : grad v,   -int q div u
   *
   * with the coefficients of StressCoefficients; of a scalar viscosity H there
   * is one number a point in place of a tensor. What is known of the cells is
   * kept as a sum of two numbers in single precision, to 2e-15: products in
   * double precision read both, those in single the first.
   */
  template <int dim>
  class FlowCells
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    FlowCells() = default;

    FlowCells(const MovingMesh<dim> &mesh, const Partitioner &nodes);

    /**
     * What the coefficients are like: is the viscosity a scalar, are there k
     * and B? If that changes all cells are to be set anew.
     */
    void
    set_form(const bool scalar_viscosity, const bool with_tangents);

    /**
     * What is known of an owned cell at its quadrature points.
     * @throws dealii::ExceptionBase if there is a tensor viscosity or a tangent
     * that set_form() was not told of
     */
    void
    set(const unsigned int                                        cell,
        const std::vector<typename CellValues<dim>::PointValues> &points,
        const std::vector<StressCoefficients<dim>>               &coefficients);

    /**
     * Add the sums to @p dst, by node: those of the velocities v and of the
     * pressure q. @p src has what the nodes are given.
     */
    template <typename Number>
    void
    add_product(Number *dst, const Number *src) const;

    /// With the roles of u, p and v, q exchanged.
    template <typename Number>
    void
    add_transposed_product(Number *dst, const Number *src) const;

    /// Bytes that a product reads, but for the values at the nodes.
    template <typename Number>
    std::size_t
    bytes_of_a_product() const;

  private:
    /// Owned cells that have the same quadrature rule; the last one is repeated
    /// where there are too few to be computed at once.
    struct Group
    {
      bool curved;
      /// by batch, node and cell, the local numbers of the nodes
      std::vector<unsigned int> nodes;
      /// by batch, number and cell: a value is the sum of both
      std::vector<float> numbers, remainders;
    };

    /// Where a cell is: its group, and its place among the group's cells.
    struct Place
    {
      unsigned int group = dealii::numbers::invalid_unsigned_int, index = 0;
    };

    std::vector<Group> groups;
    /// by cell of the mesh
    std::vector<Place> places;
    bool               scalar_viscosity = false, with_tangents = false;

    unsigned int
    n_numbers(const Group &group) const;

    void
    resize();

    template <bool transposed, typename Number>
    void
    add(Number *dst, const Number *src) const;
  };
} // namespace Catena

#endif

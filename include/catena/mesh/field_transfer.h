#ifndef catena_mesh_field_transfer_h
#define catena_mesh_field_transfer_h

#include <catena/mesh/moving_mesh.h>
#include <catena/mesh/point_locator.h>
#include <catena/mesh/point_tensors.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace Catena
{
  /**
   * Evaluates the fields of one mesh at the nodes and the quadrature points of
   * another, both at the same instant.
   *
   * A point that lies outside of the old mesh is looked up at its image under
   * the symmetries of the scene, and the value turned back.
   */
  template <int dim>
  class FieldTransfer
  {
  public:
    /**
     * Find the nodes of @p target, at @p target_positions, in @p source, at
     * @p source_positions. The meshes are kept by reference.
     *
     * @throws MeshError if a node is farther from the old mesh than the size
     * of an element
     */
    FieldTransfer(const MovingMesh<dim> &source,
                  const VectorType      &source_positions,
                  const MovingMesh<dim> &target,
                  const VectorType      &target_positions);

    /// A P2 vector field.
    VectorType
    vector(const VectorType &field) const;

    /// A P1 scalar field, which changes its sign under the rotation if @p odd.
    VectorType
    scalar(const VectorType &field, const bool odd = false) const;

    /// The components of a symmetric P1 tensor field, by interpolation.
    std::vector<VectorType>
    tensor(const std::vector<VectorType> &components) const;

    using Tensors        = std::vector<dealii::SymmetricTensor<2, dim>>;
    using TensorFunction = std::function<dealii::SymmetricTensor<2, dim>(
      const dealii::SymmetricTensor<2, dim> &)>;

    /// Tensors at the points of CellValues<dim> of all cells of the target.
    struct AtPoints
    {
      Tensors of_field, of_points;
    };

    /**
     * The function of a symmetric P1 tensor field, and tensors at the points of
     * the source, in each of its cells the linear function closest to them
     * (L2); zero if there are none.
     *
     * In a straight cell they are the linear function closest to what is found
     * at many points (L2): what jumps from cell to cell of the source counts by
     * its share of the volume.
     */
    AtPoints
    conserved_at_points(const std::vector<VectorType> &components,
                        const TensorFunction          &function,
                        const PointTensors<dim>       &tensors) const;

  private:
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    /// A point of the new mesh in the old one.
    struct Place
    {
      unsigned int       cell;
      dealii::Point<dim> unit;
      bool               turned;
    };

    const MovingMesh<dim> &source;
    const MovingMesh<dim> &target;
    const VectorType       target_positions;
    /// under which a point outside of the old mesh may lie in it
    const std::vector<Image<dim>> images;
    const PointLocator<dim>       locator;
    /// of the owned P2 nodes of the target, in their order
    std::vector<Place> node_places;

    Place
    find(const dealii::Point<dim> &point, double &violation) const;

    /// Of a point among others near it, with the cells in which those are.
    Place
    find(const dealii::Point<dim>  &point,
         std::vector<unsigned int> &cells_nearby) const;

    /// Values of a P1 field at the vertices of all cells of the source.
    std::vector<std::array<double, n_vertices>>
    gather_vertex_values(const VectorType &field) const;

    /// At the vertices of a cell of the source: of a field, and of tensors at
    /// points.
    using VertexTensors =
      std::array<dealii::SymmetricTensor<2, dim>, n_vertices>;
    using CellTensors = std::array<VertexTensors, 2>;

    std::vector<CellTensors>
    gather_cell_tensors(const std::vector<VectorType> &components,
                        const PointTensors<dim>       &tensors) const;
  };
} // namespace Catena

#endif

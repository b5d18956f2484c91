#ifndef catena_mesh_field_transfer_h
#define catena_mesh_field_transfer_h

#include <catena/mesh/moving_mesh.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * Values of fields of one mesh at the nodes of another, both at the same
   * instant. A node that lies outside of the old mesh is looked up at its
   * image under the symmetries of the scene, and the value turned back.
   */
  template <int dim>
  class FieldTransfer
  {
  public:
    /**
     * Find the owned nodes of @p target, at @p target_positions, in
     * @p source, at @p source_positions.
     *
     * @throws MeshError if a node is farther from the old mesh than a tenth
     * of an element
     */
    FieldTransfer(const MovingMesh<dim> &source,
                  const VectorType      &source_positions,
                  const MovingMesh<dim> &target,
                  const VectorType      &target_positions);

    /// A P2 vector field.
    VectorType
    vector(const VectorType &field) const;

    /// A P1 scalar field.
    VectorType
    scalar(const VectorType &field) const;

    /// The components of a symmetric P1 tensor field.
    std::vector<VectorType>
    tensor(const std::vector<VectorType> &components) const;

  private:
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    struct Place
    {
      unsigned int                   node;
      unsigned int                   cell;
      bool                           turned;
      std::array<double, n_nodes>    quadratic;
      std::array<double, n_vertices> linear;
    };

    const MovingMesh<dim> &source;
    const MovingMesh<dim> &target;
    std::vector<Place>     places;

    /// Values of P1 field at the vertices of all cells of the source.
    std::vector<std::array<double, n_vertices>>
    gather_vertex_values(const VectorType &field) const;

    VectorType
    scalar(const VectorType &field, const bool odd) const;
  };
} // namespace Catena

#endif

#ifndef catena_mesh_mesh_description_h
#define catena_mesh_mesh_description_h

#include <catena/base/archive.h>
#include <catena/scene/scene.h>

#include <deal.II/base/point.h>

#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Catena
{
  /**
   * A straight-sided mesh as lists of vertices and cells, with the boundary
   * ids of BoundaryIds.
   */
  template <int dim>
  struct MeshDescription
  {
    static constexpr unsigned int dimension = dim;

    std::vector<dealii::Point<dim>>    vertices;
    std::vector<dealii::CellData<dim>> cells;
    dealii::SubCellData                boundary;

    /// smallest radius ratio of all cells, -1 if the curved faces of the
    /// particles invert one
    double quality = 0.;
    /// how many meshes were made until one was accepted
    unsigned int attempts = 0;

    /// Save or load vertices, cells and boundary.
    /// @throws CheckpointError if what is loaded is no mesh
    void
    archive(Archive &archive);
  };



  /// The faces of a mesh that have a boundary id.
  template <typename Mesh>
  auto &
  boundary_faces(Mesh &mesh)
  {
    if constexpr (Mesh::dimension == 3)
      return mesh.boundary.boundary_quads;
    else
      return mesh.boundary.boundary_lines;
  }



  /// The vertices of a face in ascending order, to find it by.
  template <int dim>
  std::array<unsigned int, dim>
  sorted_vertices(const std::vector<unsigned int> &vertices)
  {
    std::array<unsigned int, dim> sorted;
    std::copy(vertices.begin(), vertices.end(), sorted.begin());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }



  /// The smallest quality of the cells, those with faces on particles curved
  /// (quadratic_simplex_quality()); -1 if there are none.
  template <int dim>
  double
  smallest_quality(const Scene<dim> &scene, const MeshDescription<dim> &mesh);

  /**
   * Remove cells that lie flat on a particle, with two faces on it: the
   * particle gets the other two faces instead. Such cells come with a
   * diagonal of two surface triangles that is not the outer one, and would be
   * inverted by curved faces. (A triangle has no two sides on a disc.)
   */
  template <int dim>
  void
  remove_flat_cells(MeshDescription<dim> &mesh);

  /// Give all cells a positive volume.
  template <int dim>
  void
  orient_cells(MeshDescription<dim> &mesh);

  /**
   * Order the cells along a Hilbert curve and number the vertices as the
   * cells meet them.
   */
  template <int dim>
  void
  order_along_curve(MeshDescription<dim> &mesh);
} // namespace Catena

#endif

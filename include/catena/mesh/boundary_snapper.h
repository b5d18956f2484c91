#ifndef catena_mesh_boundary_snapper_h
#define catena_mesh_boundary_snapper_h

#include <catena/mesh/mesh_description.h>
#include <catena/scene/scene.h>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace Catena
{
  /**
   * Puts the nodes on the boundary exactly where they belong: on planes, on
   * spheres, and on the images of the nodes they are identified with.
   */
  template <int dim>
  class BoundarySnapper
  {
  public:
    BoundarySnapper(const Scene<dim> &scene, MeshDescription<dim> &mesh);

    /// Put the nodes on planes there, again after they were matched.
    void
    snap_to_planes();

    /// @throws MeshError if nodes or faces do not match.
    void
    match(const Identification<dim> &identification);

  private:
    using Face = std::array<unsigned int, dim>;

    void
    snap_to_particles();

    /// Move of the image of a face along x by which it is in the block.
    double
    period_of(const Identification<dim> &identification,
              const Face                &face) const;

    unsigned int
    find(const dealii::Point<dim> &p) const;

    using Cell = std::array<long, dim>;

    Cell
    grid_cell(const dealii::Point<dim> &p) const;

    const Scene<dim>     &scene;
    MeshDescription<dim> &mesh;

    std::vector<std::vector<dealii::types::boundary_id>> ids;
    std::map<dealii::types::boundary_id, std::set<Face>> faces;
    std::map<Cell, std::vector<unsigned int>>            grid;
  };
} // namespace Catena

#endif

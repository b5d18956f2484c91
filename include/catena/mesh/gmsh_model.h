#ifndef catena_mesh_gmsh_model_h
#define catena_mesh_gmsh_model_h

#include <catena/mesh/gmsh_session.h>
#include <catena/mesh/mesh_description.h>
#include <catena/mesh/size_field.h>
#include <catena/scene/scene.h>

#include <map>
#include <vector>

namespace Catena
{
  /**
   * How gmsh makes a mesh.
   */
  struct MeshingOptions
  {
    enum Algorithm
    {
      /// the same input gives the same mesh
      delaunay = 1,
      /// does not give the same mesh again, not even on one thread
      hxt = 10
    };

    Algorithm algorithm = delaunay;

    /// passes of optimisation after the standard one
    unsigned int optimisations = 0;
  };

  /**
   * The geometry of a scene in gmsh: the meshed block less the particles, with
   * the planes that are identified with themselves split into halves.
   *
   * All functions throw MeshError where gmsh fails.
   */
  template <int dim>
  class GmshModel
  {
  public:
    /// Build the geometry as the current gmsh model.
    explicit GmshModel(const Scene<dim> &scene);

    /**
     * Make the mesh and return vertices, cells and boundary faces as gmsh
     * numbers them, without vertices that no cell uses.
     */
    MeshDescription<dim>
    generate(const SizeField<dim> &size, const MeshingOptions &options);

  private:
    /// Tags of the surfaces (curves for dim = 2) with a boundary id.
    using Surfaces = std::map<dealii::types::boundary_id, std::vector<int>>;

    void
    build_block();

    void
    split_identified_planes();

    void
    classify_surfaces();

    dealii::types::boundary_id
    boundary_id(const int tag) const;

    void
    identify_surfaces() const;

    MeshDescription<dim>
    extract() const;

    const Scene<dim>     scene;
    const OwnedGmshModel model;
    int                  volume = 0;
    Surfaces             surfaces;
  };
} // namespace Catena

#endif

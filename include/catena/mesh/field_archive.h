#ifndef catena_mesh_field_archive_h
#define catena_mesh_field_archive_h

#include <catena/base/archive.h>
#include <catena/base/types.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/mesh/point_tensors.h>

namespace Catena
{
  /**
   * Archives fields of a mesh: as their number of values and the values in
   * the order of MovingMesh::node_order(), which is the same on any number of
   * ranks; tensors at points with the numbers of their cells.
   *
   * While saving, the values are gathered on rank 0, whose archive alone is
   * complete. While loading, every rank has the whole archive and takes what
   * it owns. All functions are collective.
   */
  template <int dim>
  class FieldArchive
  {
  public:
    /// Both are kept by reference.
    FieldArchive(Archive &archive, const MovingMesh<dim> &mesh)
      : archive(archive)
      , mesh(mesh)
    {}

    /// Values without a field.
    template <typename... T>
    void
    operator()(T &...values)
    {
      archive(values...);
    }

    bool
    is_loading() const
    {
      return archive.is_loading();
    }

    /**
     * A P2 vector field, may be empty. If it is empty when it is loaded it
     * gets ghost values.
     */
    void
    vector(VectorType &field);

    /// A P1 scalar field, likewise.
    void
    scalar(VectorType &field);

    /// A list of P1 scalar fields.
    void
    scalars(std::vector<VectorType> &fields);

    /// Tensors at quadrature points, may be none.
    void
    points(PointTensors<dim> &tensors)
    {
      tensors.archive(archive, mesh);
    }

  private:
    Archive               &archive;
    const MovingMesh<dim> &mesh;

    void
    save(const VectorType &field, const std::vector<unsigned int> &order);

    void
    load(VectorType                      &field,
         const std::vector<unsigned int> &order,
         const VectorType                &layout);

    std::vector<unsigned int>
    vector_order() const;

    std::vector<unsigned int>
    scalar_order() const;
  };
} // namespace Catena

#endif

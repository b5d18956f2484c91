#include <catena/simulation/state.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Save or load @p faces or cells, with the boundary ids of faces.
    template <typename Cell>
    void
    archive_cells(Archive &archive, std::vector<Cell> &cells, const bool faces)
    {
      std::vector<unsigned int>       vertices;
      std::vector<types::boundary_id> ids;
      for (const Cell &cell : cells)
        {
          vertices.insert(vertices.end(),
                          cell.vertices.begin(),
                          cell.vertices.end());
          if (faces)
            ids.push_back(cell.boundary_id);
        }
      unsigned int n_vertices = cells.empty() ? 1 : cells[0].vertices.size();
      archive(n_vertices, vertices, ids);
      if (!archive.is_loading())
        return;
      if (n_vertices < 2 || n_vertices > 4 || vertices.size() % n_vertices != 0)
        throw CheckpointError("it has cells with " +
                              std::to_string(n_vertices) + " vertices");
      cells.assign(vertices.size() / n_vertices, Cell(n_vertices));
      if (faces && ids.size() != cells.size())
        throw CheckpointError("it has faces without a boundary");
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          std::copy_n(vertices.begin() + c * n_vertices,
                      n_vertices,
                      cells[c].vertices.begin());
          if (faces)
            cells[c].boundary_id = ids[c];
        }
    }



    template <int dim>
    auto &
    boundary_faces(MeshDescription<dim> &mesh)
    {
      if constexpr (dim == 3)
        return mesh.boundary.boundary_quads;
      else
        return mesh.boundary.boundary_lines;
    }



    /// @throws CheckpointError if cells or faces have vertices that are none
    template <int dim>
    void
    check(MeshDescription<dim> &mesh)
    {
      const auto check_vertices = [&](const auto &cells, const unsigned int n) {
        for (const auto &cell : cells)
          if (cell.vertices.size() != n ||
              *std::max_element(cell.vertices.begin(), cell.vertices.end()) >=
                mesh.vertices.size())
            throw CheckpointError("its mesh has cells without vertices");
      };
      check_vertices(mesh.cells, dim + 1);
      check_vertices(boundary_faces(mesh), dim);
      for (const Point<dim> &vertex : mesh.vertices)
        if (!std::isfinite(vertex.norm()))
          throw CheckpointError("it has values that are not finite");
      if (mesh.cells.empty())
        throw CheckpointError("it has no mesh");
    }
  } // namespace



  template <int dim>
  void
  Discretization<dim>::archive(Archive          &archive,
                               const Scene<dim> &scene,
                               const MPI_Comm    communicator)
  {
    const bool           loading = archive.is_loading();
    MeshDescription<dim> description;
    Scene<dim>           layout = scene;
    Configuration<dim>   reference;
    if (!loading)
      {
        description = mesh->description();
        layout      = mesh->scene();
        reference   = mover->reference_configuration();
      }
    archive(layout.cut,
            layout.window_centre,
            reference,
            initial_quality,
            description.vertices);
    archive_cells(archive, description.cells, false);
    archive_cells(archive, boundary_faces(description), true);
    if (!loading)
      return;

    check(description);
    if (reference.centres.size() != layout.particles.size())
      throw CheckpointError("it has " +
                            std::to_string(reference.centres.size()) +
                            " particles, there should be " +
                            std::to_string(layout.particles.size()));
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      layout.particles[i].centre = reference.centres[i];
    mover.reset();
    mesh = std::make_unique<MovingMesh<dim>>(communicator, layout, description);
    mover = std::make_unique<MeshMover<dim>>(*mesh, reference);
  }



  template <int dim>
  void
  Level<dim>::archive(FieldArchive<dim> &archive)
  {
    archive(time, configuration);
    archive.vector(positions);
    archive.vector(flow.velocity);
    archive.scalar(flow.pressure);
    archive(flow.motions,
            flow.contact_forces,
            flow.pressure_drop,
            flow.reactions);
    archive.scalars(log_conformation);
  }



  template <int dim>
  void
  State<dim>::archive(Archive          &archive,
                      const Scene<dim> &scene,
                      const MPI_Comm    communicator)
  {
    if (archive.is_loading())
      *this = State<dim>();
    discretization.archive(archive, scene, communicator);
    FieldArchive<dim> fields(archive, *discretization.mesh);
    discretization.mover->archive(fields);
    now.archive(fields);
    before.archive(fields);
    fields(last_dt, holding_forces);
    if (archive.is_loading())
      {
        if (now.positions.size() == 0 ||
            now.configuration.centres.size() != scene.particles.size())
          throw CheckpointError("it has no present state");
        discretization.mesh->set_positions(now.positions);
      }
  }



  template struct Discretization<2>;
  template struct Discretization<3>;
  template struct Level<2>;
  template struct Level<3>;
  template struct State<2>;
  template struct State<3>;
} // namespace Catena

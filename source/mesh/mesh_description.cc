#include <catena/base/exceptions.h>
#include <catena/mesh/mesh_description.h>
#include <catena/mesh/quadratic_shape.h>
#include <catena/mesh/quality.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <map>
#include <numeric>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    template <int dim>
    std::array<Point<dim>, dim + 1>
    cell_vertices(const MeshDescription<dim>  &mesh,
                  const dealii::CellData<dim> &cell)
    {
      std::array<Point<dim>, dim + 1> points;
      for (unsigned int i = 0; i <= dim; ++i)
        points[i] = mesh.vertices[cell.vertices[i]];
      return points;
    }
  } // namespace



  template <int dim>
  double
  smallest_quality(const Scene<dim> &scene, const MeshDescription<dim> &mesh)
  {
    using Edge = std::array<unsigned int, 2>;
    std::map<Edge, Point<dim>> curved;
    const auto                 surfaces = scene.surfaces();
    for (const auto &face : boundary_faces(mesh))
      if (face.boundary_id >= BoundaryIds::particle)
        for (const unsigned int a : face.vertices)
          for (const unsigned int b : face.vertices)
            if (a < b)
              curved[{{a, b}}] =
                surfaces[face.boundary_id - BoundaryIds::particle].nearest(
                  (mesh.vertices[a] + mesh.vertices[b]) / 2.);

    double smallest = mesh.cells.empty() ? -1. : 1.;
    for (const auto &cell : mesh.cells)
      {
        const auto vertices = cell_vertices(mesh, cell);
        std::array<Point<dim>, n_quadratic_nodes(dim)> nodes;
        std::copy(vertices.begin(), vertices.end(), nodes.begin());
        for (unsigned int i = dim + 1; i < nodes.size(); ++i)
          {
            const auto ends = simplex_edge(i - dim - 1);
            const auto edge =
              std::minmax(cell.vertices[ends[0]], cell.vertices[ends[1]]);
            const auto found = curved.find({{edge.first, edge.second}});
            nodes[i]         = found != curved.end() ?
                                 found->second :
                                 (nodes[ends[0]] + nodes[ends[1]]) / 2.;
          }
        smallest = std::min(smallest, quadratic_simplex_quality<dim>(nodes));
      }
    return smallest;
  }



  template <>
  void
  remove_flat_cells<3>(MeshDescription<3> &mesh)
  {
    using Face = std::array<unsigned int, 3>;
    std::map<Face, unsigned int>            number;
    std::vector<dealii::types::boundary_id> on(mesh.vertices.size(), 0);

    auto &faces = boundary_faces(mesh);
    for (unsigned int f = 0; f < faces.size(); ++f)
      if (faces[f].boundary_id >= BoundaryIds::particle)
        {
          number[sorted_vertices<3>(faces[f].vertices)] = f;
          for (const unsigned int v : faces[f].vertices)
            on[v] = faces[f].boundary_id;
        }

    const auto is_flat = [&](const dealii::CellData<3> &cell) {
      const std::vector<unsigned int> &v = cell.vertices;
      if (on[v[0]] == 0 || on[v[0]] != on[v[1]] || on[v[0]] != on[v[2]] ||
          on[v[0]] != on[v[3]])
        return false;

      // the faces opposite to the vertices, those on the particle first
      std::vector<Face> old_faces, new_faces;
      for (unsigned int i = 0; i < 4; ++i)
        {
          std::vector<unsigned int> face = v;
          face.erase(face.begin() + i);
          const Face key = sorted_vertices<3>(face);
          (number.count(key) > 0 ? old_faces : new_faces).push_back(key);
        }
      if (old_faces.size() != 2)
        return false;

      for (unsigned int i = 0; i < 2; ++i)
        {
          const unsigned int f = number[old_faces[i]];
          number.erase(old_faces[i]);
          number[new_faces[i]] = f;
          faces[f].vertices.assign(new_faces[i].begin(), new_faces[i].end());
        }
      return true;
    };

    // what lay on a removed cell may be flat now
    for (bool again = true; again;)
      {
        const auto end =
          std::remove_if(mesh.cells.begin(), mesh.cells.end(), is_flat);
        again = end != mesh.cells.end();
        mesh.cells.erase(end, mesh.cells.end());
      }
  }



  template <>
  void
  remove_flat_cells<2>(MeshDescription<2> &)
  {}


  template <int dim>
  void
  orient_cells(MeshDescription<dim> &mesh)
  {
    for (auto &cell : mesh.cells)
      if (simplex_volume<dim>(cell_vertices(mesh, cell)) < 0.)
        std::swap(cell.vertices[0], cell.vertices[1]);
  }



  template <int dim>
  void
  order_along_curve(MeshDescription<dim> &mesh)
  {
    std::vector<Point<dim>> centres;
    centres.reserve(mesh.cells.size());
    for (const auto &cell : mesh.cells)
      {
        dealii::Tensor<1, dim> centre;
        for (const unsigned int v : cell.vertices)
          centre += mesh.vertices[v] / (dim + 1.);
        centres.emplace_back(centre);
      }
    const auto positions =
      dealii::Utilities::inverse_Hilbert_space_filling_curve(centres, 20);

    std::vector<unsigned int> order(mesh.cells.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](unsigned int a, unsigned int b) {
      return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
    });

    constexpr unsigned int    unset = dealii::numbers::invalid_unsigned_int;
    std::vector<unsigned int> number(mesh.vertices.size(), unset);
    std::vector<Point<dim>>   vertices;
    std::vector<dealii::CellData<dim>> cells;
    cells.reserve(order.size());
    for (const unsigned int c : order)
      {
        cells.push_back(mesh.cells[c]);
        for (unsigned int &v : cells.back().vertices)
          {
            if (number[v] == unset)
              {
                number[v] = vertices.size();
                vertices.push_back(mesh.vertices[v]);
              }
            v = number[v];
          }
      }
    for (auto &face : boundary_faces(mesh))
      for (unsigned int &v : face.vertices)
        v = number[v];
    mesh.vertices = std::move(vertices);
    mesh.cells    = std::move(cells);
  }



  namespace
  {
    /// Save or load cells or faces, all with @p n vertices.
    template <typename Cell>
    void
    archive_cells(Archive &archive, std::vector<Cell> &cells, const unsigned n)
    {
      std::vector<unsigned int>               vertices;
      std::vector<dealii::types::boundary_id> ids;
      for (const Cell &cell : cells)
        {
          vertices.insert(vertices.end(),
                          cell.vertices.begin(),
                          cell.vertices.end());
          ids.push_back(cell.boundary_id);
        }
      archive(vertices, ids);
      if (!archive.is_loading())
        return;
      if (ids.size() * n != vertices.size())
        throw CheckpointError("its mesh has cells without vertices");
      cells.assign(ids.size(), Cell(n));
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          std::copy_n(vertices.begin() + c * n, n, cells[c].vertices.begin());
          cells[c].boundary_id = ids[c];
        }
    }
  } // namespace


  template <int dim>
  void
  MeshDescription<dim>::archive(Archive &archive)
  {
    archive(vertices);
    archive_cells(archive, cells, dim + 1);
    archive_cells(archive, boundary_faces(*this), dim);
    if (!archive.is_loading())
      return;

    const auto check_vertices = [&](const auto &list) {
      for (const auto &cell : list)
        for (const unsigned int v : cell.vertices)
          if (v >= vertices.size())
            throw CheckpointError("its mesh has cells without vertices");
    };
    check_vertices(cells);
    check_vertices(boundary_faces(*this));
    for (const Point<dim> &vertex : vertices)
      if (!std::isfinite(vertex.norm()))
        throw CheckpointError("it has values that are not finite");
    if (cells.empty())
      throw CheckpointError("it has no mesh");
  }



  template struct MeshDescription<2>;
  template double
  smallest_quality(const Scene<2> &, const MeshDescription<2> &);
  template void
  orient_cells(MeshDescription<2> &);
  template void
  order_along_curve(MeshDescription<2> &);
  template struct MeshDescription<3>;
  template double
  smallest_quality(const Scene<3> &, const MeshDescription<3> &);
  template void
  orient_cells(MeshDescription<3> &);
  template void
  order_along_curve(MeshDescription<3> &);
} // namespace Catena

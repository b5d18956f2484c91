#include <catena/base/child_process.h>
#include <catena/base/exceptions.h>
#include <catena/mesh/boundary_snapper.h>
#include <catena/mesh/gmsh_model.h>
#include <catena/mesh/mesher.h>
#include <catena/mesh/quadratic_shape.h>
#include <catena/mesh/quality.h>
#include <catena/mesh/size_field.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <vector>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// One try at a mesh: sizes are multiplied by scale.
    struct Attempt
    {
      double         scale;
      MeshingOptions options;
    };

    /// The tries in their order, those that cannot be repeated exactly last.
    const std::vector<Attempt> attempts = {
      {1.00, {MeshingOptions::delaunay, 0}},
      {0.97, {MeshingOptions::delaunay, 0}},
      {1.03, {MeshingOptions::delaunay, 0}},
      {0.94, {MeshingOptions::delaunay, 0}},
      {1.00, {MeshingOptions::delaunay, 3}},
      {0.91, {MeshingOptions::delaunay, 3}},
      {1.00, {MeshingOptions::hxt, 0}},
      {0.97, {MeshingOptions::hxt, 3}}};



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



    /// The quality of the cells with their faces on particles curved.
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

      double quality = mesh.cells.empty() ? -1. : 1.;
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
          quality = std::min(quality, quadratic_simplex_quality<dim>(nodes));
        }
      return quality;
    }



    /**
     * Remove cells that lie flat on a particle, with two faces on it: the
     * particle gets the other two faces instead. Such cells come with a
     * diagonal of two surface triangles that is not the outer one, and would be
     * inverted by curved faces.
     */
    void
    remove_flat_cells(MeshDescription<3> &mesh)
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



    /// A triangle has no two sides on a disc.
    void
    remove_flat_cells(MeshDescription<2> &)
    {}



    /// Give all cells a positive volume.
    template <int dim>
    void
    orient_cells(MeshDescription<dim> &mesh)
    {
      for (auto &cell : mesh.cells)
        if (simplex_volume<dim>(cell_vertices(mesh, cell)) < 0.)
          std::swap(cell.vertices[0], cell.vertices[1]);
    }



    /**
     * Order the cells along a Hilbert curve and number the vertices as the
     * cells meet them.
     */
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
      std::sort(order.begin(),
                order.end(),
                [&](unsigned int a, unsigned int b) {
                  return positions[a] != positions[b] ?
                           positions[a] < positions[b] :
                           a < b;
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



    /// Boundary, orientation and order of a mesh as gmsh gives it.
    template <int dim>
    void
    finish(const Scene<dim> &scene, MeshDescription<dim> &mesh)
    {
      remove_flat_cells(mesh);
      orient_cells(mesh);
      {
        BoundarySnapper<dim> snapper(scene, mesh);
        // the second pass carries a node through a chain of images
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (const auto &identification : scene.identifications())
            snapper.match(identification);
        snapper.snap_to_planes();
      }
      order_along_curve(mesh);
    }
  } // namespace



  template <int dim>
  MeshDescription<dim>
  generate_mesh(const Scene<dim>                              &scene,
                const MeshParameters                          &parameters,
                const std::function<void(const unsigned int)> &before_attempt)
  {
    parameters.check();

    double       best  = -std::numeric_limits<double>::infinity();
    unsigned int count = 0;
    std::string  failure;
    for (const auto &attempt : attempts)
      {
        ++count;
        const auto make = [&]() {
          if (before_attempt)
            before_attempt(count);
          GmshModel<dim>       model(scene);
          MeshDescription<dim> mesh =
            model.generate(SizeField<dim>(scene, parameters, attempt.scale),
                           attempt.options);
          finish(scene, mesh);
          Archive archive;
          archive(mesh);
          return archive.bytes();
        };
        try
          {
            Archive archive(run_in_child(make, parameters.time_limit));
            MeshDescription<dim> mesh;
            archive(mesh);
            mesh.quality  = smallest_quality(scene, mesh);
            mesh.attempts = count;
            if (mesh.quality >= parameters.minimal_quality)
              return mesh;
            best = std::max(best, mesh.quality);
          }
        catch (const Error &error)
          {
            failure = std::string("; last failure: ") + error.what();
          }
      }

    std::ostringstream text;
    text << "No acceptable mesh in " << count << " attempts: best quality "
         << best << ", wanted " << parameters.minimal_quality
         << "; raise 'Elements on equator' or lower 'Minimal quality'"
         << failure;
    throw MeshError(text.str());
  }



  void
  MeshParameters::declare(dealii::ParameterHandler &parameters)
  {
    using namespace dealii::Patterns;
    parameters.add_parameter(
      "Elements on equator",
      elements_on_equator,
      "n_part, elements along the equator of a particle: their size is "
      "2 pi a / n_part. At least 8.",
      Integer(0));
    parameters.add_parameter(
      "Elements across gap",
      elements_across_gap,
      "n_min, smallest number of elements across the gap between two "
      "particles or a particle and a wall. At least 1.",
      Integer(0));
    parameters.add_parameter(
      "Gap stretch",
      gap_stretch,
      "How many times longer elements may be along a gap between particles "
      "than across it: the mesh is made with gaps as many times wider, and "
      "pressed. From 1 to 8.",
      Double());
    parameters.add_parameter(
      "Size growth",
      growth,
      "Growth of the element size per unit of distance from a particle "
      "(a per a) at 64 elements on the equator. A finer mesh grows slower, as "
      "n_part^(-2/3), to be finer everywhere. Between 0.01 and 1.",
      Double());
    parameters.add_parameter("Maximal size",
                             maximal_size,
                             "Largest element size, in particle radii a.",
                             Double());
    parameters.add_parameter(
      "Minimal quality",
      minimal_quality,
      "Smallest quality (inscribed over circumscribed radius, 1 for the "
      "regular simplex) of a cell that is accepted; a mesh with a worse cell "
      "is made again. Between 0 and 0.3.",
      Double());
    parameters.add_parameter("Time limit",
                             time_limit,
                             "Wall time after which an attempt at a mesh has "
                             "failed, and another one is made [s].",
                             Double());
  }



  void
  MeshParameters::check() const
  {
    require(elements_on_equator >= 8 && elements_on_equator <= 2000,
            "Elements on equator",
            elements_on_equator,
            "give a number from 8 to 2000");
    require(elements_across_gap >= 1 && elements_across_gap <= 20,
            "Elements across gap",
            elements_across_gap,
            "give a number from 1 to 20");
    require(gap_stretch >= 1. && gap_stretch <= 8.,
            "Gap stretch",
            gap_stretch,
            "give a number from 1 to 8");
    require(growth >= 0.01 && growth <= 1.,
            "Size growth",
            growth,
            "give a number from 0.01 to 1");
    require(maximal_size >= 1e-3 && maximal_size <= 1e4,
            "Maximal size",
            maximal_size,
            "give a positive length in particle radii, from 1e-3 to 1e4");
    require(minimal_quality >= 0. && minimal_quality <= 0.3,
            "Minimal quality",
            minimal_quality,
            "give a number from 0 to 0.3");
    require(time_limit >= 1. && time_limit <= 1e6,
            "Time limit",
            time_limit,
            "give a time from 1 to 1e6 seconds");
  }



  double
  MeshParameters::widest_refined_gap() const
  {
    return 2. * dealii::numbers::PI * elements_across_gap / elements_on_equator;
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
  template struct MeshDescription<3>;
  template MeshDescription<2>
  generate_mesh(const Scene<2> &,
                const MeshParameters &,
                const std::function<void(const unsigned int)> &);
  template MeshDescription<3>
  generate_mesh(const Scene<3> &,
                const MeshParameters &,
                const std::function<void(const unsigned int)> &);
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/mesh/gmsh_geometry.h>
#include <catena/mesh/gmsh_model.h>
#include <catena/mesh/gmsh_session.h>

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// Removes the size callback at the end of a scope.
    struct SizeCallback
    {
      template <int dim>
      explicit SizeCallback(const SizeField<dim> &size)
      {
        gmsh::model::mesh::setSizeCallback(
          [&size](const int, const int, double x, double y, double z) {
            Point<dim> p;
            p[0] = x;
            p[1] = y;
            if (dim == 3)
              p[dim - 1] = z;
            return size(p);
          });
      }

      ~SizeCallback()
      {
        gmsh::model::mesh::removeSizeCallback();
      }
    };



    void
    set_options(const MeshingOptions &options)
    {
      set_gmsh_options({{"Mesh.MeshSizeExtendFromBoundary", 0},
                        {"Mesh.MeshSizeFromPoints", 0},
                        {"Mesh.MeshSizeFromCurvature", 0},
                        {"Mesh.ElementOrder", 1},
                        {"Mesh.RandomSeed", 1},
                        {"Mesh.Optimize", 1},
                        {"Mesh.OptimizeNetgen", 0},
                        {"Mesh.Algorithm", 6},
                        {"Mesh.Algorithm3D", double(options.algorithm)}});
    }



    template <int dim>
    Point<dim>
    centre_of_mass(const int tag)
    {
      std::array<double, 3> c;
      gmsh::model::occ::getCenterOfMass(dim - 1, tag, c[0], c[1], c[2]);
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = c[d];
      return p;
    }



    /// A point of the sphere or plane that a surface is part of.
    template <int dim>
    Point<dim>
    point_on_surface(const int tag)
    {
      std::vector<double> low, high, coordinates;
      gmsh::model::getParametrizationBounds(dim - 1, tag, low, high);
      std::vector<double> parameters(dim - 1);
      for (unsigned int d = 0; d < dim - 1; ++d)
        parameters[d] = (low[d] + high[d]) / 2.;
      gmsh::model::getValue(dim - 1, tag, parameters, coordinates);

      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = coordinates[d];
      return p;
    }
  } // namespace



  template <int dim>
  GmshModel<dim>::GmshModel(const Scene<dim> &scene)
    : scene(scene)
  {
    call_gmsh("build the geometry", [&]() {
      build_block();
      split_identified_planes();
      gmsh::model::occ::synchronize();
      classify_surfaces();
      identify_surfaces();
    });
  }



  template <int dim>
  void
  GmshModel<dim>::build_block()
  {
    namespace occ = gmsh::model::occ;

    const Point<dim>             low  = scene.lower();
    const dealii::Tensor<1, dim> size = scene.upper() - low;

    const int block =
      dim == 3 ?
        occ::addBox(
          low[0], low[1], low[dim - 1], size[0], size[1], size[dim - 1]) :
        occ::addRectangle(low[0], low[1], 0., size[0], size[1]);
    gmsh::vectorpair spheres;
    for (const auto &surface : scene.surfaces())
      spheres.emplace_back(dim, add_particle(scene, surface));

    gmsh::vectorpair              result = {{dim, block}};
    std::vector<gmsh::vectorpair> origin;
    if (!spheres.empty())
      occ::cut({{dim, block}}, spheres, result, origin);
    if (result.size() != 1)
      throw MeshError("the particles cut the box into " +
                      std::to_string(result.size()) +
                      " parts; move them or choose another symmetry");
    volume = result[0].second;
  }



  template <int dim>
  void
  GmshModel<dim>::split_identified_planes()
  {
    gmsh::vectorpair tools;
    for (const auto &identification : scene.identifications())
      if (identification.rotation)
        for (const double position : split_positions(scene, identification))
          {
            const bool on_y = identification.from == BoundaryIds::y_low;
            const auto part =
              splitting_entities(scene,
                                 on_y ? position : identification.shift,
                                 on_y ? 0. : position);
            tools.insert(tools.end(), part.begin(), part.end());
          }
    if (tools.empty())
      return;

    gmsh::vectorpair              result;
    std::vector<gmsh::vectorpair> origin;
    gmsh::model::occ::fragment({{dim, volume}}, tools, result, origin);
    for (const auto &entity : result)
      if (entity.first == dim)
        volume = entity.second;
  }



  template <int dim>
  void
  GmshModel<dim>::classify_surfaces()
  {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{dim, volume}}, boundary, false, false, false);
    std::sort(boundary.begin(), boundary.end());
    boundary.erase(std::unique(boundary.begin(), boundary.end()),
                   boundary.end());
    for (const auto &entity : boundary)
      surfaces[boundary_id(entity.second)].push_back(entity.second);
  }



  template <int dim>
  dealii::types::boundary_id
  GmshModel<dim>::boundary_id(const int tag) const
  {
    std::array<double, 3> low, high;
    gmsh::model::getBoundingBox(
      dim - 1, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    for (unsigned int d = 0; d < dim; ++d)
      if (high[d] - low[d] < geometric_tolerance)
        {
          if (std::abs(low[d] - scene.lower()[d]) < geometric_tolerance)
            return 2 * d;
          if (std::abs(low[d] - scene.upper()[d]) < geometric_tolerance)
            return 2 * d + 1;
        }

    const Point<dim> p     = point_on_surface<dim>(tag);
    const auto       parts = scene.surfaces();
    for (unsigned int i = 0; i < parts.size(); ++i)
      if (std::abs(p.distance(parts[i].centre) - parts[i].radius) <
          geometric_tolerance * parts[i].radius)
        return BoundaryIds::particle + i;

    throw MeshError("a surface of the mesh belongs to no plane and no "
                    "particle; check that particles do not touch");
  }



  template <int dim>
  void
  GmshModel<dim>::identify_surfaces() const
  {
    for (const auto &identification : scene.identifications())
      for (const int master : surfaces.at(identification.from))
        {
          const Point<dim> centre = centre_of_mass<dim>(master);
          bool             found  = false;
          for (const int k : {0, 1, -1})
            for (const int slave : surfaces.at(identification.to))
              {
                const double moved = k * identification.period;
                Point<dim>   image = identification.image(centre);
                image[0] += moved;
                if (found || image.distance(centre_of_mass<dim>(slave)) >
                               geometric_tolerance)
                  continue;
                found = true;
                // of two halves the one that comes first is the master
                if (slave == master ||
                    (identification.rotation &&
                     image[0] + image[1] < centre[0] + centre[1]))
                  continue;

                const double s = identification.rotation ? -1. : 1.;
                const double x =
                  (identification.rotation ? 2. : 1.) * identification.shift +
                  moved;
                gmsh::model::mesh::setPeriodic(
                  dim - 1,
                  {slave},
                  {master},
                  {s, 0, 0, x, 0, s, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
              }
          if (!found)
            throw MeshError("part of an identified plane has no counterpart; "
                            "move the particles away from it");
        }
  }



  template <int dim>
  MeshDescription<dim>
  GmshModel<dim>::generate(const SizeField<dim> &size,
                           const MeshingOptions &options)
  {
    MeshDescription<dim> mesh;
    call_gmsh("make the mesh", [&]() {
      model.make_current();
      gmsh::model::mesh::clear();
      set_options(options);
      const SizeCallback callback(size);
      gmsh::model::mesh::generate(dim);
      if (options.optimisations > 0)
        gmsh::model::mesh::optimize("", true, options.optimisations);
      mesh = extract();
    });
    return mesh;
  }



  template <int dim>
  MeshDescription<dim>
  GmshModel<dim>::extract() const
  {
    // gmsh's types of simplices: 1 line, 2 triangle, 4 tetrahedron
    const int cell_type = dim == 3 ? 4 : 2;
    const int face_type = dim == 3 ? 2 : 1;

    std::vector<std::size_t> node_tags, elements, nodes;
    std::vector<double>      coordinates, parameters;
    gmsh::model::mesh::getNodes(
      node_tags, coordinates, parameters, -1, -1, false, false);
    gmsh::model::mesh::getElementsByType(cell_type, elements, nodes);

    MeshDescription<dim>                          mesh;
    std::unordered_map<std::size_t, unsigned int> number;
    for (const std::size_t tag : nodes)
      number[tag] = 0;
    for (std::size_t i = 0; i < node_tags.size(); ++i)
      {
        const auto used = number.find(node_tags[i]);
        if (used == number.end())
          continue;
        used->second = mesh.vertices.size();
        mesh.vertices.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          mesh.vertices.back()[d] = coordinates[3 * i + d];
      }

    mesh.cells.assign(elements.size(), dealii::CellData<dim>(dim + 1));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      mesh.cells[i / (dim + 1)].vertices[i % (dim + 1)] = number.at(nodes[i]);

    for (const auto &group : surfaces)
      for (const int tag : group.second)
        {
          // gmsh fills vectors that are not empty without resizing them
          elements.clear();
          nodes.clear();
          gmsh::model::mesh::getElementsByType(face_type, elements, nodes, tag);
          for (std::size_t i = 0; i < elements.size(); ++i)
            {
              dealii::CellData<dim - 1> face(dim);
              face.boundary_id = group.first;
              for (unsigned int k = 0; k < dim; ++k)
                {
                  const auto found = number.find(nodes[dim * i + k]);
                  if (found == number.end())
                    throw MeshError("gmsh left part of the block without "
                                    "cells; change the resolution");
                  face.vertices[k] = found->second;
                }
              boundary_faces(mesh).push_back(face);
            }
        }
    return mesh;
  }



  template class GmshModel<2>;
  template class GmshModel<3>;
} // namespace Catena

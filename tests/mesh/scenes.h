#ifndef catena_tests_mesh_scenes_h
#define catena_tests_mesh_scenes_h

#include <catena/base/types.h>
#include <catena/mesh/boundary_snapper.h>
#include <catena/mesh/mesher.h>
#include <catena/mesh/quadratic_shape.h>
#include <catena/scene/scene.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    template <int dim>
    dealii::Point<dim>
    polar(const double distance, const double degrees)
    {
      dealii::Point<dim> p;
      p[0] = distance * std::cos(degrees * dealii::numbers::PI / 180.);
      p[1] = distance * std::sin(degrees * dealii::numbers::PI / 180.);
      return p;
    }



    /// A particle on the axis and one beside it, rotationally symmetric.
    template <int dim>
    Scene<dim>
    three_particles(const double distance = 2.04,
                    const double degrees  = 10.,
                    const Cut    cut      = Cut::x_plane)
    {
      Scene<dim> scene;
      scene.symmetry  = Symmetry::quarter;
      scene.cut       = cut;
      scene.particles = {{dealii::Point<dim>(), 1., true},
                         {polar<dim>(distance, degrees), 1., false}};
      return scene;
    }



    template <int dim>
    Scene<dim>
    two_particles(const Symmetry symmetry, const double distance = 2.04)
    {
      Scene<dim> scene;
      scene.symmetry  = symmetry;
      scene.particles = {{polar<dim>(distance / 2., 10.)},
                         {polar<dim>(distance / 2., 190.)}};
      return scene;
    }



    inline MeshParameters
    resolution(const unsigned int on_equator, const unsigned int across_gap)
    {
      MeshParameters parameters;
      parameters.elements_on_equator = on_equator;
      parameters.elements_across_gap = across_gap;
      return parameters;
    }



    /**
     * The quadratic nodes of the cells of a mesh; middles of edges on a
     * particle are moved to its surface if @p curved.
     */
    template <int dim>
    std::vector<std::array<dealii::Point<dim>, n_quadratic_nodes(dim)>>
    quadratic_nodes(const Scene<dim>           &scene,
                    const MeshDescription<dim> &mesh,
                    const bool                  curved)
    {
      // edges of faces on particles, as pairs of vertices
      std::map<std::array<unsigned int, 2>, unsigned int> edges;
      for (const auto &face : boundary_faces(mesh))
        if (curved && face.boundary_id >= BoundaryIds::particle)
          for (const unsigned int a : face.vertices)
            for (const unsigned int b : face.vertices)
              edges[{{a, b}}] = face.boundary_id - BoundaryIds::particle;

      std::vector<std::array<dealii::Point<dim>, n_quadratic_nodes(dim)>> nodes;
      for (const auto &cell : mesh.cells)
        {
          nodes.emplace_back();
          auto &x = nodes.back();
          for (unsigned int v = 0; v <= dim; ++v)
            x[v] = mesh.vertices[cell.vertices[v]];
          for (unsigned int i = dim + 1; i < x.size(); ++i)
            {
              const auto edge = simplex_edge(i - dim - 1);
              x[i]            = x[edge[0]] + (x[edge[1]] - x[edge[0]]) / 2.;
              const auto found =
                edges.find({{cell.vertices[edge[0]], cell.vertices[edge[1]]}});
              if (found == edges.end())
                continue;
              const auto &particle = scene.particles[found->second];
              const auto  arm      = x[i] - particle.centre;
              x[i] = particle.centre + particle.radius / arm.norm() * arm;
            }
        }
      return nodes;
    }
  } // namespace Tests
} // namespace Catena

#endif

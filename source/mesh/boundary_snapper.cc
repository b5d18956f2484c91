#include <catena/base/exceptions.h>
#include <catena/mesh/boundary_snapper.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// how well the nodes of identified planes must agree
    constexpr double matching_tolerance = 1e-10;
  } // namespace



  template <int dim>
  BoundarySnapper<dim>::BoundarySnapper(const Scene<dim>     &scene,
                                        MeshDescription<dim> &mesh)
    : scene(scene)
    , mesh(mesh)
    , ids(mesh.vertices.size())
  {
    for (const auto &face : boundary_faces(mesh))
      {
        faces[face.boundary_id].insert(sorted_vertices<dim>(face.vertices));
        for (const unsigned int v : face.vertices)
          if (std::find(ids[v].begin(), ids[v].end(), face.boundary_id) ==
              ids[v].end())
            ids[v].push_back(face.boundary_id);
      }

    snap_to_planes();
    snap_to_particles();
    for (unsigned int v = 0; v < ids.size(); ++v)
      if (!ids[v].empty())
        grid[grid_cell(mesh.vertices[v])].push_back(v);
  }



  template <int dim>
  void
  BoundarySnapper<dim>::snap_to_planes()
  {
    for (unsigned int v = 0; v < ids.size(); ++v)
      for (const auto id : ids[v])
        if (id < 2 * dim)
          mesh.vertices[v][id / 2] =
            (id % 2 == 0 ? scene.lower() : scene.upper())[id / 2];
  }



  template <int dim>
  void
  BoundarySnapper<dim>::snap_to_particles()
  {
    const auto surfaces = scene.surfaces();
    for (unsigned int v = 0; v < ids.size(); ++v)
      for (const auto id : ids[v])
        if (id >= BoundaryIds::particle)
          {
            const auto &particle = surfaces[id - BoundaryIds::particle];

            // only coordinates that no plane prescribes are scaled
            std::array<bool, dim> fixed = {};
            for (const auto other : ids[v])
              if (other < 2 * dim)
                fixed[other / 2] = true;

            Point<dim> &p          = mesh.vertices[v];
            double      prescribed = 0., free = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              (fixed[d] ? prescribed : free) +=
                std::pow(p[d] - particle.centre[d], 2);
            const double wanted =
              particle.radius * particle.radius - prescribed;
            if (free > 0. && wanted > 0.)
              for (unsigned int d = 0; d < dim; ++d)
                if (!fixed[d])
                  p[d] = particle.centre[d] +
                         (p[d] - particle.centre[d]) * std::sqrt(wanted / free);
          }
  }



  template <int dim>
  typename BoundarySnapper<dim>::Cell
  BoundarySnapper<dim>::grid_cell(const Point<dim> &p) const
  {
    Cell cell;
    for (unsigned int d = 0; d < dim; ++d)
      cell[d] = std::lround(p[d] / (1e4 * matching_tolerance));
    return cell;
  }



  template <int dim>
  unsigned int
  BoundarySnapper<dim>::find(const Point<dim> &p) const
  {
    const Cell centre = grid_cell(p);
    for (int i = 0; i < dealii::Utilities::pow(3, dim); ++i)
      {
        Cell cell = centre;
        for (int d = 0, n = i; d < dim; ++d, n /= 3)
          cell[d] += n % 3 - 1;
        const auto found = grid.find(cell);
        if (found != grid.end())
          for (const unsigned int v : found->second)
            if (mesh.vertices[v].distance(p) < matching_tolerance)
              return v;
      }
    throw MeshError("the meshes of two identified planes do not match; "
                    "change the resolution or move the particles away");
  }



  template <int dim>
  double
  BoundarySnapper<dim>::period_of(const Identification<dim> &identification,
                                  const Face                &face) const
  {
    double x = 0.;
    for (const unsigned int v : face)
      x += identification.image(mesh.vertices[v])[0] / dim;
    const double period = identification.period;
    return period > 0. ? -period * std::floor((x - scene.lower()[0]) / period) :
                         0.;
  }



  template <int dim>
  void
  BoundarySnapper<dim>::match(const Identification<dim> &identification)
  {
    for (const Face &face : faces[identification.from])
      {
        const double move = period_of(identification, face);
        Face         partner;
        for (unsigned int k = 0; k < dim; ++k)
          {
            Point<dim> &p     = mesh.vertices[face[k]];
            Point<dim>  image = identification.image(p);
            image[0] += move;
            partner[k] = find(image);
            if (partner[k] == face[k])
              p = p + (image - p) / 2.;
            else if (face[k] < partner[k] || !identification.rotation)
              mesh.vertices[partner[k]] = image;
          }
        std::sort(partner.begin(), partner.end());
        if (faces[identification.to].count(partner) == 0)
          throw MeshError("the faces of two identified planes do not match; "
                          "change the resolution");
      }
  }



  template class BoundarySnapper<2>;
  template class BoundarySnapper<3>;
} // namespace Catena

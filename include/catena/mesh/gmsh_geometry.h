#ifndef catena_mesh_gmsh_geometry_h
#define catena_mesh_gmsh_geometry_h

#include <catena/scene/scene.h>

#include <utility>
#include <vector>

namespace Catena
{
  /// Distance in a within which a geometry is taken to be on a plane.
  constexpr double geometric_tolerance = 1e-5;

  /**
   * Where the plane (edge for dim = 2) of a rotation is split so that each
   * part is carried to another: at the axes and where the image of an end of
   * the window falls. Values of the coordinate in the plane, normal to z.
   */
  template <int dim>
  std::vector<double>
  split_positions(const Scene<dim>          &scene,
                  const Identification<dim> &identification);

  /// The gmsh entities that split a boundary along the line (x, y).
  template <int dim>
  std::vector<std::pair<int, int>>
  splitting_entities(const Scene<dim> &scene, const double x, const double y);

  /**
   * Add the particle of a surface to the model of gmsh's OpenCASCADE kernel.
   *
   * @return the tag of the volume (surface for dim = 2)
   */
  template <int dim>
  int
  add_particle(const Scene<dim> &scene, const Surface<dim> &surface);
} // namespace Catena

#endif

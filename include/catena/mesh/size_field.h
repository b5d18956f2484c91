#ifndef catena_mesh_size_field_h
#define catena_mesh_size_field_h

#include <catena/mesh/mesher.h>
#include <catena/scene/scene.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Catena
{
  /**
   * The element size wanted at a point, the smallest of
   *
   * - h0 + g d, with h0 = 2 pi r / n_part on the surface of a particle of
   *   radius r, d the distance to that surface and g the growth: that of
   *   MeshParameters at n_part = 64, else times (64/n_part)^(2/3), so that a
   *   mesh with smaller elements on the particles is finer everywhere;
   * - w / n_min, with w = d_1 + d_2 the local width of a gap: the sum of the
   *   distances to the two nearest surfaces (particles, their images, walls
   *   and mirror planes), never less than the narrowest gap of the scene;
   * - 3 w with w the distances to a particle and to an identified plane that
   *   it comes close to: no physical gap, but elements as flat as that;
   * - the maximal size.
   *
   * A gap so narrow that it would ask for less than h0/50 gets h0/50: the
   * elements in a gap w number about n_min^3/w. The field has the symmetries of
   * the scene.
   */
  template <int dim>
  class SizeField
  {
  public:
    /**
     * @param scale multiplies all sizes.
     */
    SizeField(const Scene<dim>     &scene,
              const MeshParameters &parameters,
              const double          scale = 1.);

    /// Size wanted at @p p, in particle radii.
    double
    operator()(const dealii::Point<dim> &p) const;

  private:
    /// A particle or an image of one, with the planes it has a gap to.
    struct Sphere
    {
      dealii::Point<dim>        centre;
      double                    radius;
      std::vector<unsigned int> planes;
    };

    /// Plane x_direction = position and how many elements a gap to it gets.
    struct Plane
    {
      unsigned int direction;
      double       position;
      double       elements_across;
    };

    void
    collect_spheres(const Scene<dim> &scene);

    void
    collect_planes(const Scene<dim> &scene);

    void
    find_narrowest_gap();

    double growth;
    double maximal_size;
    double elements_on_equator;
    double elements_across_gap;
    double scale;
    /// width of the narrowest gap
    double gap;

    std::vector<Sphere> spheres;
    std::vector<Plane>  planes;
  };
} // namespace Catena

#endif

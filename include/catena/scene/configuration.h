#ifndef catena_scene_configuration_h
#define catena_scene_configuration_h

#include <catena/base/archive.h>

#include <deal.II/base/point.h>

#include <cmath>
#include <vector>

namespace Catena
{
  /**
   * Where the meshed particles are at one instant, how far the frame of the
   * mesh on their surfaces has turned about z, and what shears the fluid.
   */
  template <int dim>
  struct Configuration
  {
    std::vector<dealii::Point<dim>> centres;
    /// angle of the frame [rad]
    double frame_angle = 0.;
    /// rate of the imposed shear [gamma]: -1 when it is reversed, 0 for walls
    /// at rest
    double shear_rate = 1.;

    /// Save or load it.
    void
    archive(Archive &archive)
    {
      archive(centres, frame_angle, shear_rate);
    }
  };



  /**
   * @p v turned about the z-axis by @p angle.
   */
  template <int dim>
  dealii::Tensor<1, dim>
  turned_about_z(const dealii::Tensor<1, dim> &v, const double angle)
  {
    dealii::Tensor<1, dim> w = v;
    const double           c = std::cos(angle), s = std::sin(angle);
    w[0] = c * v[0] - s * v[1];
    w[1] = s * v[0] + c * v[1];
    return w;
  }
} // namespace Catena

#endif

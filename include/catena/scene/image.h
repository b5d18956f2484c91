#ifndef catena_scene_image_h
#define catena_scene_image_h

#include <catena/base/archive.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace Catena
{
  /**
   * A map that leaves the whole flow as it is: a rotation by 180 degrees about
   * the z-axis, or none, followed by a shift along x.
   */
  template <int dim>
  struct Image
  {
    bool   turned = false;
    double shift  = 0.;

    /// A velocity, force, angular velocity or arm. Its own inverse.
    dealii::Tensor<1, dim>
    turn(dealii::Tensor<1, dim> v) const
    {
      if (turned)
        {
          v[0] = -v[0];
          v[1] = -v[1];
        }
      return v;
    }

    /// The image of a point.
    dealii::Point<dim>
    operator()(const dealii::Point<dim> &p) const
    {
      dealii::Point<dim> q(turn(p));
      q[0] += shift;
      return q;
    }

    /// The point whose image is @p p.
    dealii::Point<dim>
    origin(dealii::Point<dim> p) const
    {
      p[0] -= shift;
      return dealii::Point<dim>(turn(p));
    }

    /// Save or load it.
    void
    archive(Archive &archive)
    {
      archive(turned, shift);
    }
  };
} // namespace Catena

#endif

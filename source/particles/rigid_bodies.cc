#include <catena/particles/rigid_bodies.h>

#include <deal.II/base/numbers.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim>
    rotation_velocity(const Tensor<1, 3> &omega, const Tensor<1, dim> &arm)
    {
      Tensor<1, 3> r;
      for (unsigned int d = 0; d < dim; ++d)
        r[d] = arm[d];
      const Tensor<1, 3> v = cross_product_3d(omega, r);
      Tensor<1, dim>     u;
      for (unsigned int d = 0; d < dim; ++d)
        u[d] = v[d];
      return u;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  RigidMotion<dim>::at(const Tensor<1, dim> &arm) const
  {
    return velocity + rotation_velocity<dim>(angular_velocity, arm);
  }



  template <int dim>
  RigidBodies<dim>::RigidBodies(const Scene<dim> &scene)
  {
    offsets.push_back(0);
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      {
        const Particle<dim> &p        = scene.particles[i];
        const bool           in_plane = dim == 2 || scene.in_mirror_plane(i);

        if (!p.on_axis)
          for (unsigned int d = 0; d < (in_plane ? 2 : dim); ++d)
            unknowns.push_back({i, false, d});
        for (unsigned int d = (in_plane ? 2 : 0); d < 3; ++d)
          unknowns.push_back({i, true, d});

        offsets.push_back(unknowns.size());
        shares.push_back(1. / scene.multiplicity(i));
        fixed.push_back(p.fixed);
        volumes.push_back((dim == 2 ? 1. : 4. / 3. * p.radius) * numbers::PI *
                          p.radius * p.radius);
      }
  }



  template <int dim>
  double
  RigidBodies<dim>::displaced_volume(const unsigned int k) const
  {
    const Unknown &unknown = unknowns[k];
    return unknown.rotation || unknown.axis != 0 ? 0. :
                                                   volumes[unknown.particle];
  }



  template <int dim>
  bool
  RigidBodies<dim>::any_held() const
  {
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      if (!is_free(k))
        return true;
    return false;
  }



  template <int dim>
  Tensor<1, dim>
  RigidBodies<dim>::unit_velocity(const unsigned int    k,
                                  const Tensor<1, dim> &arm) const
  {
    RigidMotion<dim> motion;
    if (unknowns[k].rotation)
      motion.angular_velocity[unknowns[k].axis] = 1.;
    else
      motion.velocity[unknowns[k].axis] = 1.;
    return motion.at(arm);
  }



  template <int dim>
  std::vector<RigidMotion<dim>>
  RigidBodies<dim>::motions(const std::vector<double> &values) const
  {
    std::vector<RigidMotion<dim>> result(offsets.size() - 1);
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      {
        RigidMotion<dim> &motion = result[unknowns[k].particle];
        if (unknowns[k].rotation)
          motion.angular_velocity[unknowns[k].axis] = values[k];
        else
          motion.velocity[unknowns[k].axis] = values[k];
      }
    return result;
  }



  template <int dim>
  std::vector<double>
  RigidBodies<dim>::values(const std::vector<RigidMotion<dim>> &motions) const
  {
    std::vector<double> result(unknowns.size());
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      {
        const RigidMotion<dim> &motion = motions[unknowns[k].particle];
        result[k]                      = unknowns[k].rotation ?
                                           motion.angular_velocity[unknowns[k].axis] :
                                           motion.velocity[unknowns[k].axis];
      }
    return result;
  }



  template struct RigidMotion<2>;
  template struct RigidMotion<3>;
  template class RigidBodies<2>;
  template class RigidBodies<3>;
} // namespace Catena

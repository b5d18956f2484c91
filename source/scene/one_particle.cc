#include <catena/base/exceptions.h>
#include <catena/scene/one_particle.h>

namespace Catena
{
  using namespace dealii;

  void
  OneParticleParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    box.declare(prm);
    prm.leave_subsection();
  }



  void
  OneParticleParameters::check() const
  {
    box.check();
    for (const auto &size : {std::make_pair("Scene/Length", box.length),
                             std::make_pair("Scene/Height", box.height),
                             std::make_pair("Scene/Width", box.width)})
      require(size.second > 2.,
              size.first,
              size.second,
              "enlarge the box: it must be wider than the particle");
    scene<3>().check();
  }



  template <int dim>
  Scene<dim>
  OneParticleParameters::scene() const
  {
    Scene<dim> result = box.scene<dim>(Symmetry::quarter);
    result.particles  = {{Point<dim>(), 1., true}};
    return result;
  }



  template Scene<2>
  OneParticleParameters::scene<2>() const;
  template Scene<3>
  OneParticleParameters::scene<3>() const;
} // namespace Catena

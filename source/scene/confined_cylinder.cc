#include <catena/base/exceptions.h>
#include <catena/scene/confined_cylinder.h>

namespace Catena
{
  using namespace dealii;

  void
  ConfinedCylinderParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    prm.add_parameter("Length",
                      length,
                      "L, period along the channel, in radii of the cylinder: "
                      "the distance of a cylinder to the next one.",
                      Patterns::Double());
    prm.add_parameter("Height",
                      height,
                      "2 H, distance of the walls, in radii of the cylinder.",
                      Patterns::Double());
    prm.leave_subsection();
  }



  void
  ConfinedCylinderParameters::check() const
  {
    require(length > 2.,
            "Scene/Length",
            length,
            "enlarge the period: it must be longer than the cylinder");
    require(height > 2.,
            "Scene/Height",
            height,
            "enlarge the channel: it must be wider than the cylinder");
    for (const auto &size : {std::make_pair("Scene/Length", length),
                             std::make_pair("Scene/Height", height)})
      require(size.second <= 1e4,
              size.first,
              size.second,
              "give a size of at most 10000 radii");
    scene().check();
  }



  template <>
  Scene<2>
  ConfinedCylinderParameters::scene() const
  {
    Scene<2> result;
    result.length = length;
    result.height = height;
    result.drive  = Drive::pressure;

    Particle<2> cylinder;
    cylinder.fixed   = true;
    result.particles = {cylinder};
    return result;
  }
} // namespace Catena

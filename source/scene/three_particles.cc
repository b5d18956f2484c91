#include <catena/base/exceptions.h>
#include <catena/scene/three_particles.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  void
  ThreeParticlesParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    prm.add_parameter("Length",
                      length,
                      "L, period of the box along the flow [a].",
                      Patterns::Double());
    prm.add_parameter("Height",
                      height,
                      "H, distance of the walls [a].",
                      Patterns::Double());
    prm.add_parameter("Width",
                      width,
                      "W, width of the box along the vorticity [a].",
                      Patterns::Double());
    prm.add_parameter("Distance",
                      distance,
                      "Distance of the outer centres from the middle one at "
                      "the start [a].",
                      Patterns::Double());
    prm.add_parameter("Angle",
                      angle,
                      "Angle of the line of centres against the flow at the "
                      "start [degrees].",
                      Patterns::Double());
    prm.leave_subsection();
  }



  void
  ThreeParticlesParameters::check() const
  {
    for (const auto &size : {std::make_pair("Scene/Length", length),
                             std::make_pair("Scene/Height", height),
                             std::make_pair("Scene/Width", width)})
      require(size.second > 0.,
              size.first,
              size.second,
              "give a positive size");
    require(width > 2.,
            "Scene/Width",
            width,
            "enlarge the box: it must be wider than a particle");
    require(distance > 2.,
            "Scene/Distance",
            distance,
            "the particles overlap: choose more than 2");
    require(std::abs(angle) < 45.,
            "Scene/Angle",
            angle,
            "choose an angle between -45 and 45 degrees");

    const double x = distance * std::cos(angle * numbers::PI / 180.);
    const double y = distance * std::sin(angle * numbers::PI / 180.);
    require(std::abs(y) + 1. < height / 2.,
            "Scene/Height",
            height,
            "the outer particle is in a wall: enlarge the box or move it");
    require(x + 1. < length / 2.,
            "Scene/Length",
            length,
            "the outer particle meets its periodic image: enlarge the box or "
            "move it");
    scene<3>().check();
  }



  template <int dim>
  Scene<dim>
  ThreeParticlesParameters::scene() const
  {
    Scene<dim> result;
    result.length   = length;
    result.height   = height;
    result.width    = width;
    result.symmetry = Symmetry::quarter;
    result.particles.resize(2);
    result.particles[0].on_axis = true;
    result.particles[1].centre[0] =
      distance * std::cos(angle * numbers::PI / 180.);
    result.particles[1].centre[1] =
      distance * std::sin(angle * numbers::PI / 180.);
    return result;
  }



  template Scene<2>
  ThreeParticlesParameters::scene<2>() const;
  template Scene<3>
  ThreeParticlesParameters::scene<3>() const;
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/scene/line_of_particles.h>

#include <deal.II/base/numbers.h>

#include <array>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  LineOfParticlesParameters::LineOfParticlesParameters(
    const unsigned int n_particles)
    : distance(n_particles == 2 ? 1.5 : 3.)
    , n_particles(n_particles)
  {
    Assert(n_particles == 2 || n_particles == 3, ExcNotImplemented());
  }



  void
  LineOfParticlesParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    box.declare(prm);
    declare_domain(prm,
                   "full|half|quarter",
                   "The part of the box that is meshed: half of it by the "
                   "mirror plane of the particles, or a quarter, as the "
                   "particles stay symmetric about the origin. All give the "
                   "same motion.",
                   symmetry);
    prm.add_parameter("Distance",
                      distance,
                      n_particles == 2 ?
                        "Distance of the centres from the origin at the start "
                        "[a]; half of their distance from each other." :
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
  LineOfParticlesParameters::check() const
  {
    box.check();
    require(box.width > 2.,
            "Scene/Width",
            box.width,
            "enlarge the box: it must be wider than a particle");
    const double touching = n_particles == 2 ? 1. : 2.;
    require(distance > touching,
            "Scene/Distance",
            distance,
            "the particles overlap: choose more than " +
              std::to_string(static_cast<int>(touching)));
    require(std::abs(angle) <= 90.,
            "Scene/Angle",
            angle,
            "choose an angle between -90 and 90 degrees");

    const double x = distance * std::cos(angle * numbers::PI / 180.);
    const double y = distance * std::sin(angle * numbers::PI / 180.);
    require(std::abs(y) + 1. < box.height / 2.,
            "Scene/Height",
            box.height,
            "the outer particle is in a wall: enlarge the box or move it");
    require(x + 1. < box.length / 2.,
            "Scene/Length",
            box.length,
            "the outer particle meets its periodic image: enlarge the box or "
            "move it");
    scene<3>().check();
  }



  template <int dim>
  Scene<dim>
  LineOfParticlesParameters::scene() const
  {
    Scene<dim> result = box.scene<dim>(symmetry);
    Point<dim> outer;
    outer[0]              = distance * std::cos(angle * numbers::PI / 180.);
    outer[1]              = distance * std::sin(angle * numbers::PI / 180.);
    const bool rotational = symmetry == Symmetry::quarter;
    if (n_particles == 3)
      {
        Particle<dim> middle;
        middle.on_axis = rotational;
        result.particles.push_back(middle);
      }
    const unsigned int first = result.particles.size();
    result.particles.push_back({outer});
    if (!rotational)
      result.particles.push_back({-outer});
    const unsigned int other = n_particles == 3 ? 0 : 1;
    result.line =
      std::array<unsigned int, 2>{{first, rotational ? first : other}};
    return result;
  }



  template Scene<2>
  LineOfParticlesParameters::scene<2>() const;
  template Scene<3>
  LineOfParticlesParameters::scene<3>() const;
} // namespace Catena

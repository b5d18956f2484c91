// A scene that makes no sense is refused in one line that names the parameter,
// the value and a remedy, whether it is filled in a program or from the
// parameters of one.

#include <catena/base/exceptions.h>
#include <catena/scene/line_of_particles.h>
#include <catena/scene/scene.h>

#include <functional>
#include <limits>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

/**
 * Claim that @p check refuses with a message of the form
 * "Parameter 'NAME' = VALUE: REMEDY" that holds all @p words.
 */
void
refused(Tests::Claims                  &claims,
        const std::string              &name,
        const std::function<void()>    &check,
        const std::vector<std::string> &words)
{
  std::string message = "accepted";
  try
    {
      check();
    }
  catch (const InputError &error)
    {
      message = error.what();
    }
  bool good =
    message.find("Parameter '") == 0 && message.find('\n') == std::string::npos;
  for (const std::string &word : words)
    good = good && message.find(word) != std::string::npos;
  std::cout << message << std::endl;
  claims.holds(name, good);
}



template <int dim>
Scene<dim>
one_particle(const Point<dim> &centre, const Symmetry symmetry = Symmetry::none)
{
  Scene<dim> scene;
  scene.symmetry = symmetry;
  scene.particles.push_back({centre});
  return scene;
}



void
boxes(Tests::Claims &claims)
{
  const auto with = [](double Scene<3>::*const size, const double value) {
    return [=]() {
      auto scene  = one_particle<3>(Point<3>());
      scene.*size = value;
      scene.check();
    };
  };
  refused(claims,
          "negative length",
          with(&Scene<3>::length, -80.),
          {"'Scene/Length' = -80", "positive"});
  refused(claims,
          "negative height",
          with(&Scene<3>::height, -40.),
          {"'Scene/Height' = -40", "positive"});
  refused(claims,
          "negative width",
          with(&Scene<3>::width, -20.),
          {"'Scene/Width' = -20", "positive"});
  refused(claims,
          "pressure-driven flow in the quarter",
          []() {
            auto scene  = one_particle<3>(Point<3>(), Symmetry::quarter);
            scene.drive = Drive::pressure;
            scene.check();
          },
          {"'Scene/Domain' = quarter", "half or full"});
  refused(claims,
          "no width",
          with(&Scene<3>::width, 0.),
          {"'Scene/Width' = 0", "positive"});
  refused(claims,
          "a width that is no number",
          with(&Scene<3>::width, std::numeric_limits<double>::quiet_NaN()),
          {"'Scene/Width' = nan", "positive"});
  refused(claims,
          "a box thinner than a particle",
          with(&Scene<3>::width, 1.9),
          {"'Scene/Width' = 1.9", "wider than a particle"});
}



template <int dim>
void
places(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  const auto at = [](const double x, const double y, const Symmetry symmetry) {
    return [=]() {
      Point<dim> centre;
      centre[0] = x;
      centre[1] = y;
      one_particle<dim>(centre, symmetry).check();
    };
  };
  const std::string name = "'centre of particle 0' = ";
  refused(claims,
          "in the upper wall" + suffix,
          at(0., 19.5, Symmetry::none),
          {name + "0 19.5", "wall", "move it or enlarge the box"});
  refused(claims,
          "in the lower wall" + suffix,
          at(0., -19.5, Symmetry::none),
          {name + "0 -19.5", "wall"});
  refused(claims,
          "outside of the box" + suffix,
          at(0., 25., Symmetry::none),
          {name + "0 25", "wall"});
  refused(claims,
          "touching a wall" + suffix,
          at(0., 19., Symmetry::none),
          {name + "0 19", "wall"});
  refused(claims,
          "on the axis by name only" + suffix,
          []() {
            Point<dim> centre;
            centre[0]  = 3.;
            auto scene = one_particle<dim>(centre, Symmetry::quarter);
            scene.particles[0].on_axis = true;
            scene.check();
          },
          {name + "3 0", "at the origin"});
  if (dim == 3)
    refused(claims,
            "on the axis beside the mirror plane" + suffix,
            []() {
              Point<dim> centre;
              centre[dim - 1] = 3.;
              auto scene      = one_particle<dim>(centre, Symmetry::quarter);
              scene.particles[0].on_axis = true;
              scene.check();
            },
            {name + "0 0 3", "at the origin"});
  refused(claims,
          "no radius" + suffix,
          []() {
            auto scene                = one_particle<dim>(Point<dim>());
            scene.particles[0].radius = 0.;
            scene.check();
          },
          {"'radius of particle 0' = 0", "positive"});
}



void
mirror_planes(Tests::Claims &claims)
{
  refused(claims,
          "across the mirror plane",
          []() {
            one_particle<3>(Point<3>(3., 3., 0.5), Symmetry::half).check();
          },
          {"'centre of particle 0' = 3 3 0.5", "mirror plane", "z = 0"});
  refused(claims,
          "across the far mirror plane",
          []() {
            one_particle<3>(Point<3>(3., 3., 9.5), Symmetry::half).check();
          },
          {"'centre of particle 0' = 3 3 9.5", "mirror plane"});
  refused(claims,
          "behind the mirror plane",
          []() {
            one_particle<3>(Point<3>(3., 3., -3.), Symmetry::half).check();
          },
          {"'centre of particle 0' = 3 3 -3", "mirror plane"});
}



template <int dim>
void
overlaps(Tests::Claims &claims)
{
  const std::string suffix = dim == 2 ? ", 2D" : ", 3D";
  const auto        two    = [](const double   x0,
                      const double   x1,
                      const double   y1,
                      const Symmetry symmetry,
                      const bool     on_axis) {
    return [=]() {
      Point<dim> a, b;
      a[0]       = x0;
      b[0]       = x1;
      b[1]       = y1;
      auto scene = one_particle<dim>(a, symmetry);
      scene.particles.push_back({b});
      scene.particles[0].on_axis = on_axis;
      scene.check();
    };
  };
  const std::string remedy = "overlap; move them apart";
  refused(claims,
          "overlapping particles" + suffix,
          two(0., 1.9, 0., Symmetry::none, false),
          {"'gap between particles 0 and 1' = -0.1", remedy});
  refused(claims,
          "touching particles" + suffix,
          two(0., 2., 0., Symmetry::none, false),
          {"'gap between particles 0 and 1' = 0", remedy});
  refused(claims,
          "the same particle twice" + suffix,
          two(5., 5., 0., Symmetry::none, false),
          {"'gap between particles 0 and 1' = -2", remedy});
  refused(claims,
          "overlap with the one on the axis" + suffix,
          two(0., 1.5, 1.1, Symmetry::quarter, true),
          {"'gap between particles 0 and 1' = -0.13", remedy});
}



void
sensible_scenes(Tests::Claims &claims)
{
  const auto accepted = [&](const std::string &name, const auto &scene) {
    std::string message;
    try
      {
        scene.check();
      }
    catch (const InputError &error)
      {
        message = error.what();
      }
    claims.holds(name + " is accepted" + message, message.empty());
  };
  accepted("an empty box", Scene<3>());
  accepted("a particle anywhere", one_particle<3>(Point<3>(5., -18.9, -8.9)));
  accepted("a particle on the mirror plane",
           one_particle<3>(Point<3>(5., 3., 0.), Symmetry::half));
  accepted("a particle off the mirror plane",
           one_particle<3>(Point<3>(5., 3., 1.1), Symmetry::half));
  accepted("a particle close to its image",
           one_particle<3>(Point<3>(1.001, 0.1, 0.), Symmetry::quarter));
  accepted("a disc", one_particle<2>(Point<2>(5., 3.)));
  accepted("a particle across the end of the period",
           one_particle<3>(Point<3>(39.5, 0., 3.)));
  accepted("a particle across the plane of the rotation",
           one_particle<3>(Point<3>(0.5, 3., 0.), Symmetry::quarter));

  for (const unsigned int n : {2, 3})
    {
      LineOfParticlesParameters parameters(n);
      const std::string         name = std::to_string(n) + " particles, ";
      accepted(name + "the paper's scene", parameters);
      parameters.distance = n - 0.999;
      accepted(name + "closer", parameters);
      parameters.symmetry = Symmetry::half;
      accepted(name + "half of the box", parameters);
    }
}



void
three_particles(Tests::Claims &claims)
{
  const auto with = [](double LineOfParticlesParameters::*const entry,
                       const double                             value) {
    return [=]() {
      LineOfParticlesParameters parameters(3);
      parameters.*entry = value;
      parameters.check();
    };
  };
  const auto with_box = [](double BoxParameters::*const entry,
                           const double                 value) {
    return [=]() {
      LineOfParticlesParameters parameters(3);
      parameters.box.*entry = value;
      parameters.check();
    };
  };
  using Parameters = LineOfParticlesParameters;
  refused(claims,
          "three particles: overlap",
          with(&Parameters::distance, 1.9),
          {"'Scene/Distance' = 1.9", "overlap", "more than 2"});
  refused(claims,
          "three particles: negative distance",
          with(&Parameters::distance, -3.),
          {"'Scene/Distance' = -3", "more than 2"});
  refused(claims,
          "three particles: a distance that is no number",
          with(&Parameters::distance, std::numeric_limits<double>::quiet_NaN()),
          {"'Scene/Distance' = nan", "more than 2"});
  refused(claims,
          "three particles: steep line",
          with(&Parameters::angle, 95.),
          {"'Scene/Angle' = 95", "90"});
  refused(claims,
          "three particles: in a wall",
          with_box(&BoxParameters::height, 2.5),
          {"'Scene/Height' = 2.5", "wall", "enlarge the box"});
  refused(claims,
          "three particles: meeting the periodic image",
          with_box(&BoxParameters::length, 7.),
          {"'Scene/Length' = 7", "periodic image", "enlarge the box"});
  refused(claims,
          "three particles: negative width",
          with_box(&BoxParameters::width, -20.),
          {"'Scene/Width' = -20", "positive"});
  refused(claims,
          "three particles: thin box",
          with_box(&BoxParameters::width, 2.),
          {"'Scene/Width' = 2", "wider"});
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    boxes(claims);
    places<2>(claims);
    places<3>(claims);
    mirror_planes(claims);
    overlaps<2>(claims);
    overlaps<3>(claims);
    sensible_scenes(claims);
    three_particles(claims);
  });
}

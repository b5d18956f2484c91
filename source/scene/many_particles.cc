#include <catena/base/exceptions.h>
#include <catena/scene/many_particles.h>
#include <catena/scene/random_placement.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_particles = 2000;
  } // namespace



  ManyParticlesParameters::ManyParticlesParameters()
  {
    box.length = 20.;
    box.height = 20.;
    box.width  = 20.;
  }



  void
  ManyParticlesParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    box.declare(prm);
    declare_domain(prm,
                   "full|half",
                   "full: all of the box is meshed and particles are anywhere "
                   "in it; half: the half z >= 0, and all centres are on the "
                   "mirror plane z = 0.",
                   symmetry);
    prm.add_parameter("Centres",
                      centres,
                      "Centres of particles: x, y, z of each, separated by "
                      "semicolons [a].");
    prm.add_parameter("Radii",
                      radii,
                      "Radii [a] of the particles, those with given centres "
                      "first; repeated from the start if there are more "
                      "particles.");
    prm.add_parameter("Number",
                      number,
                      "Particles at random places, beside those with given "
                      "centres.",
                      Patterns::Integer(0));
    prm.add_parameter("Volume fraction",
                      volume_fraction,
                      "Instead of 'Number': fill up to this share of the box "
                      "with particles at random places; 0: 'Number' holds.",
                      Patterns::Double());
    prm.add_parameter("Smallest distance",
                      smallest_distance,
                      "Between the surfaces of particles at random places at "
                      "the start [a].",
                      Patterns::Double());
    prm.add_parameter("Seed",
                      seed,
                      "Of the random places; the same seed gives the same "
                      "places.",
                      Patterns::Integer(0));
    prm.leave_subsection();
  }



  void
  ManyParticlesParameters::check() const
  {
    box.check();
    require(!radii.empty(), "Scene/Radii", "", "give at least one radius");
    for (const double radius : radii)
      require(radius >= 0.01 && radius <= 100.,
              "Scene/Radii",
              radius,
              "give radii from 0.01 to 100");
    require(number <= most_particles,
            "Scene/Number",
            number,
            "choose at most " + std::to_string(most_particles));
    require(volume_fraction >= 0. && volume_fraction < 0.35,
            "Scene/Volume fraction",
            volume_fraction,
            "choose a value from 0 to 0.35, more cannot be placed at random");
    require(volume_fraction == 0. || number == 0,
            "Scene/Number",
            number,
            "give either a number or a volume fraction");
    require(volume_fraction == 0. || symmetry == Symmetry::none,
            "Scene/Volume fraction",
            volume_fraction,
            "give a number for particles on the mirror plane");
    require(smallest_distance >= 0. && smallest_distance <= 1e4,
            "Scene/Smallest distance",
            smallest_distance,
            "choose a distance of 0 or more, less than the box");
    require(!centres.empty() || number > 0 || volume_fraction > 0.,
            "Scene/Number",
            number,
            "there is no particle: give 'Centres', 'Number' or 'Volume "
            "fraction'");
    for (const Point<3> &centre : centres)
      require(symmetry == Symmetry::none || centre[2] == 0.,
              "Scene/Centres",
              centre,
              "with 'Domain' = half all centres must have z = 0");
    scene<3>().check();
  }



  std::vector<double>
  ManyParticlesParameters::random_radii() const
  {
    const auto radius = [&](const unsigned int i) {
      return radii[i % radii.size()];
    };
    const auto volume = [&](const unsigned int i) {
      return 4. / 3. * numbers::PI * std::pow(radius(i), 3);
    };
    std::vector<double> result;
    unsigned int        i = centres.size();
    if (volume_fraction == 0.)
      for (unsigned int k = 0; k < number; ++k)
        result.push_back(radius(i++));
    else
      {
        double left = volume_fraction * box.length * box.height * box.width;
        for (unsigned int k = 0; k < centres.size(); ++k)
          left -= volume(k);
        for (; left > volume(i) / 2.; ++i)
          {
            require(result.size() < most_particles,
                    "Scene/Volume fraction",
                    volume_fraction,
                    "these are more than " + std::to_string(most_particles) +
                      " particles: choose larger ones or a smaller box");
            result.push_back(radius(i));
            left -= volume(i);
          }
      }
    return result;
  }



  template <int dim>
  Scene<dim>
  ManyParticlesParameters::scene() const
  {
    Scene<dim> result = box.scene<dim>(symmetry);
    for (unsigned int i = 0; i < centres.size(); ++i)
      result.particles.push_back({centres[i], radii[i % radii.size()]});
    result.check();
    place_at_random(result, random_radii(), smallest_distance, seed);
    return result;
  }



  template Scene<3>
  ManyParticlesParameters::scene<3>() const;
} // namespace Catena

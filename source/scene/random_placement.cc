#include <catena/base/exceptions.h>
#include <catena/scene/random_placement.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_trials = 100000;

    /// Uniform in [low, high); the same numbers with every standard library.
    double
    uniform(std::mt19937_64 &generator, const double low, const double high)
    {
      return low + (high - low) * std::ldexp(generator() >> 11, -53);
    }



    /// Refuse what could be tried for hours, and what has no place at all.
    template <int dim>
    void
    check_room(const Scene<dim>          &scene,
               const std::vector<double> &radii,
               const double               smallest_gap)
    {
      const double widest =
        radii.empty() ? 0. : *std::max_element(radii.begin(), radii.end());
      for (unsigned int d = 1; d < dim; ++d)
        if (d == 1 || !scene.mirrored())
          require(scene.upper()[d] - scene.lower()[d] >=
                    2. * (widest + smallest_gap),
                  d == 1 ? "Scene/Height" : "Scene/Width",
                  scene.upper()[d] - scene.lower()[d],
                  "a particle and its distance from the walls have no room: "
                  "choose a larger box");

      double room = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        room *= scene.upper()[d] - scene.lower()[d];
      for (const double radius : radii)
        room -= (dim == 3 ? 4. / 3. : 1.) * numbers::PI *
                std::pow(radius, dim) / (scene.mirrored() ? 2. : 1.);
      require(room > 0.,
              "Scene/Number",
              radii.size(),
              "the particles have more volume than the box: choose fewer");
    }



    template <int dim>
    bool
    fits(const Scene<dim> &scene, const double smallest_gap)
    {
      const unsigned int last = scene.particles.size() - 1;
      for (unsigned int j = 0; j <= last; ++j)
        if (scene.gap(last, j) < smallest_gap)
          return false;
      return true;
    }
  } // namespace



  template <int dim>
  void
  place_at_random(Scene<dim>                &scene,
                  const std::vector<double> &radii,
                  const double               smallest_gap,
                  const unsigned int         seed)
  {
    std::mt19937_64    generator(seed);
    const Point<dim>   low = scene.lower(), high = scene.upper();
    const unsigned int first = scene.particles.size();
    check_room(scene, radii, smallest_gap);

    std::vector<unsigned int> order(radii.size()), places(radii.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return radii[a] > radii[b];
    });
    for (unsigned int k = 0; k < order.size(); ++k)
      {
        const double radius = radii[order[k]];
        const double margin = radius + smallest_gap;
        places[order[k]]    = first + k;
        scene.particles.push_back({Point<dim>(), radius});
        Point<dim>  &centre = scene.particles.back().centre;
        unsigned int trials = 0;
        do
          {
            require(trials++ < max_trials,
                    "Scene/Number",
                    radii.size(),
                    "particle " + std::to_string(order[k]) +
                      " found no place in " + std::to_string(max_trials) +
                      " trials; choose fewer particles, a smaller 'Scene/"
                      "Smallest distance' or a larger box");
            centre[0] = uniform(generator, low[0], high[0]);
            for (unsigned int d = 1; d < dim; ++d)
              centre[d] =
                d == 2 && scene.mirrored() ?
                  0. :
                  uniform(generator, low[d] + margin, high[d] - margin);
          }
        while (!fits(scene, smallest_gap));
      }

    std::vector<Particle<dim>> in_order(scene.particles.begin(),
                                        scene.particles.begin() + first);
    for (const unsigned int place : places)
      in_order.push_back(scene.particles[place]);
    scene.particles = in_order;
  }



  template void
  place_at_random<2>(Scene<2> &,
                     const std::vector<double> &,
                     const double,
                     const unsigned int);
  template void
  place_at_random<3>(Scene<3> &,
                     const std::vector<double> &,
                     const double,
                     const unsigned int);
} // namespace Catena

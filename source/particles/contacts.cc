#include <catena/particles/contacts.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Add @p value along @p direction to the translations of a particle.
    template <int dim>
    void
    add_translation(const RigidBodies<dim> &bodies,
                    const unsigned int      particle,
                    const Tensor<1, dim>   &direction,
                    const bool              per_meshed_share,
                    std::vector<double>    &row)
    {
      const auto range = bodies.range(particle);
      for (unsigned int k = range.first; k < range.second; ++k)
        if (!bodies.unknown(k).rotation)
          row[k] += direction[bodies.unknown(k).axis] *
                    (per_meshed_share ? bodies.meshed_share(k) : 1.);
    }
  } // namespace



  template <int dim>
  std::vector<double>
  Contact<dim>::rate(const RigidBodies<dim> &bodies) const
  {
    std::vector<double> row(bodies.n_unknowns(), 0.);
    add_translation<dim>(bodies, i, direction, false, row);
    add_translation<dim>(bodies, j, -image.turn(direction), false, row);
    return row;
  }



  template <int dim>
  std::vector<double>
  Contact<dim>::force(const RigidBodies<dim> &bodies) const
  {
    std::vector<double> column(bodies.n_unknowns(), 0.);
    add_translation<dim>(bodies, i, direction, true, column);
    if (i != j)
      add_translation<dim>(bodies, j, -image.turn(direction), true, column);
    return column;
  }



  template <int dim>
  Contacts<dim>::Contacts(const Scene<dim> &scene, const double minimal_gap)
    : scene(scene)
    , minimal_gap(minimal_gap)
  {
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
        if (i != j || (scene.rotational() && !scene.particles[i].on_axis))
          pairs.push_back({i, j});
  }



  template <int dim>
  std::pair<Tensor<1, dim>, Image<dim>>
  Contacts<dim>::separation(const Configuration<dim> &configuration,
                            const Pair               &pair) const
  {
    const auto      &x     = configuration.centres;
    const Image<dim> image = scene.nearest_image(x, pair.i, pair.j);
    return {x[pair.i] - image(x[pair.j]), image};
  }



  template <int dim>
  double
  Contacts<dim>::held_distance(const Pair &pair) const
  {
    return scene.particles[pair.i].radius + scene.particles[pair.j].radius +
           2. * minimal_gap;
  }



  template <int dim>
  std::vector<Contact<dim>>
  Contacts<dim>::held(const Configuration<dim> &configuration) const
  {
    std::vector<Contact<dim>> contacts;
    for (const Pair &pair : pairs)
      if (pair.is_held)
        {
          const auto r = separation(configuration, pair);
          contacts.push_back(
            {pair.i, pair.j, r.first / r.first.norm(), r.second});
        }
    return contacts;
  }



  template <int dim>
  unsigned int
  Contacts<dim>::n_held() const
  {
    return std::count_if(pairs.begin(), pairs.end(), [](const Pair &pair) {
      return pair.is_held;
    });
  }



  template <int dim>
  void
  Contacts<dim>::enforce(Configuration<dim> &configuration)
  {
    constexpr unsigned int max_sweeps = 1000;
    for (unsigned int sweep = 0; sweep < max_sweeps; ++sweep)
      {
        double error = 0.;
        for (Pair &pair : pairs)
          {
            const auto   r        = separation(configuration, pair);
            const double distance = r.first.norm();
            const double missing  = held_distance(pair) - distance;
            if (missing > 0. && !pair.just_released)
              pair.is_held = true;
            if (!pair.is_held && missing <= 0.)
              continue;

            error                  = std::max(error, std::abs(missing));
            const bool     i_moves = !scene.particles[pair.i].on_axis;
            const bool     j_moves = !scene.particles[pair.j].on_axis;
            const double   share   = i_moves && j_moves ? 0.5 : 1.;
            Tensor<1, dim> move    = share * missing / distance * r.first;
            if (i_moves)
              configuration.centres[pair.i] += move;
            if (j_moves && pair.i != pair.j)
              configuration.centres[pair.j] -= r.second.turn(move);
          }
        if (error < 1e-13)
          break;
      }
    for (Pair &pair : pairs)
      pair.just_released = false;
  }



  template <int dim>
  void
  Contacts<dim>::release(const std::vector<double> &forces)
  {
    unsigned int c = 0;
    for (Pair &pair : pairs)
      if (pair.is_held && forces[c++] < 0.)
        {
          pair.is_held       = false;
          pair.just_released = true;
        }
  }



  template <int dim>
  double
  Contacts<dim>::smallest_gap(const Configuration<dim> &configuration) const
  {
    double smallest = std::numeric_limits<double>::max();
    for (const Pair &pair : pairs)
      smallest = std::min(smallest,
                          separation(configuration, pair).first.norm() -
                            held_distance(pair) + 2. * minimal_gap);
    return smallest / 2.;
  }



  template struct Contact<2>;
  template struct Contact<3>;
  template class Contacts<2>;
  template class Contacts<3>;
} // namespace Catena

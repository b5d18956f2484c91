#include <catena/base/exceptions.h>
#include <catena/particles/contacts.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// gaps that differ by less are equal [a]
    constexpr double touching = 1e-10;

    /// gaps that are wider by more than this do not close in a step [a]
    constexpr double reach = 0.5;

    /// Add @p direction to the translations of a particle.
    template <int dim>
    void
    add_translation(const RigidBodies<dim> &bodies,
                    const unsigned int      particle,
                    const Tensor<1, dim>   &direction,
                    std::vector<double>    &row)
    {
      const auto range = bodies.range(particle);
      for (unsigned int k = range.first; k < range.second; ++k)
        if (!bodies.unknown(k).rotation && !bodies.is_fixed(particle))
          row[k] += direction[bodies.unknown(k).axis];
    }

    /// The norm in which displacements of all particles and images are small.
    template <int dim>
    FullMatrix<double>
    meshed_shares(const RigidBodies<dim> &bodies)
    {
      FullMatrix<double> shares(bodies.n_unknowns());
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        shares(k, k) = bodies.meshed_share(k);
      return shares;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  Contact<dim>::rate(const RigidBodies<dim> &bodies) const
  {
    std::vector<double> row(bodies.n_unknowns(), 0.);
    add_translation<dim>(bodies, i, direction, row);
    if (partner == Partner::particle)
      add_translation<dim>(bodies, j, -image.turn(direction), row);
    else if (partner == Partner::mirror_image)
      add_translation<dim>(bodies, i, direction, row);
    return row;
  }



  template <int dim>
  std::vector<double>
  forces_on_particles(const std::vector<Contact<dim>> &contacts,
                      const std::vector<double>       &forces,
                      const RigidBodies<dim>          &bodies)
  {
    AssertDimension(contacts.size(), forces.size());
    std::vector<double> result(bodies.n_unknowns(), 0.);
    for (unsigned int c = 0; c < contacts.size(); ++c)
      {
        const std::vector<double> rate = contacts[c].rate(bodies);
        for (unsigned int k = 0; k < result.size(); ++k)
          result[k] += contacts[c].meshed_share * forces[c] * rate[k] /
                       bodies.meshed_share(k);
      }
    return result;
  }



  template <int dim>
  Contacts<dim>::Contacts(const Scene<dim> &scene, const double minimal_gap)
    : scene(scene)
    , minimal_gap(minimal_gap)
    , bodies(scene)
    , displacements(meshed_shares<dim>(bodies))
  {
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      {
        for (unsigned int j = 0; j <= i; ++j)
          for (const Image<dim> &image : scene.images())
            {
              // the image of a particle on the axis is the particle; its own
              // periodic image keeps its distance
              const bool on_axis =
                scene.particles[i].on_axis || scene.particles[j].on_axis;
              const bool moves = !bodies.is_fixed(i) || !bodies.is_fixed(j);
              if (moves && (image.turned ? !on_axis : i != j))
                pairs.push_back({i, j, image, Contact<dim>::Partner::particle});
            }
        if (!scene.particles[i].on_axis && !bodies.is_fixed(i))
          add_planes(i);
      }
  }



  template <int dim>
  void
  Contacts<dim>::add_planes(const unsigned int particle)
  {
    const auto add = [&](const typename Contact<dim>::Partner partner,
                         const unsigned int                   axis,
                         const double                         low,
                         const double                         high) {
      for (const double sign : {1., -1.})
        {
          Pair pair{particle, particle, {}, partner, sign > 0. ? -low : high};
          pair.normal[axis] = sign;
          pairs.push_back(pair);
        }
    };
    add(Contact<dim>::Partner::wall, 1, -scene.height / 2., scene.height / 2.);
    if (dim == 3 && !scene.in_mirror_plane(particle))
      add(Contact<dim>::Partner::mirror_image,
          dim - 1,
          scene.lower()[dim - 1],
          scene.upper()[dim - 1]);
  }



  template <int dim>
  double
  Contacts<dim>::meshed_share(const Contact<dim> &contact) const
  {
    const bool with_itself =
      contact.i == contact.j && contact.partner != Contact<dim>::Partner::wall;
    const bool in_plane =
      scene.in_mirror_plane(contact.i) && scene.in_mirror_plane(contact.j);
    return (with_itself ? 0.5 : 1.) * (in_plane ? 0.5 : 1.);
  }



  template <int dim>
  typename Contacts<dim>::Gap
  Contacts<dim>::gap(const Configuration<dim> &configuration,
                     const Pair               &pair) const
  {
    const Point<dim> &centre = configuration.centres[pair.i];
    const double      radius = scene.particles[pair.i].radius;

    Gap gap{{pair.i, pair.j, pair.normal, pair.image, pair.partner}, 0.};
    if (pair.partner == Contact<dim>::Partner::particle)
      {
        const Tensor<1, dim> r =
          centre - pair.image(configuration.centres[pair.j]);
        gap.contact.direction = r / r.norm();
        gap.excess =
          r.norm() - radius - scene.particles[pair.j].radius - 2. * minimal_gap;
      }
    else
      {
        const double room =
          Tensor<1, dim>(centre) * pair.normal + pair.offset - radius;
        gap.excess = pair.partner == Contact<dim>::Partner::wall ?
                       room - 2. * minimal_gap :
                       2. * (room - minimal_gap);
      }
    gap.contact.meshed_share = meshed_share(gap.contact);
    return gap;
  }



  template <int dim>
  std::vector<Contact<dim>>
  Contacts<dim>::candidates(const Configuration<dim> &configuration) const
  {
    std::vector<Contact<dim>> contacts;
    for (const Pair &pair : pairs)
      {
        const Gap g = gap(configuration, pair);
        if (g.excess < touching)
          contacts.push_back(g.contact);
      }
    return contacts;
  }



  template <int dim>
  void
  Contacts<dim>::enforce(Configuration<dim> &configuration) const
  {
    constexpr unsigned int max_steps = 50;
    constexpr double       accuracy = 1e-13, acceptable = touching;

    std::vector<bool> exact(pairs.size());
    double            error = 0.;
    for (unsigned int step = 0; step <= max_steps; ++step)
      {
        std::vector<Gap> gaps;
        error = 0.;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          {
            gaps.push_back(gap(configuration, pairs[p]));
            const double excess = gaps[p].excess;
            if (step == 0)
              exact[p] = excess < reach && last_force(gaps[p].contact) > 0.;
            error = std::max(error, exact[p] ? std::abs(excess) : -excess);
          }
        if (error < accuracy || step == max_steps)
          break;
        displace(gaps, exact, configuration);
      }
    if (error > acceptable)
      throw SolverError("The particles could not be moved back to the smallest "
                        "gap: use a smaller time step.");
  }



  /**
   * A Newton step towards the smallest gaps.
   * @param exact gaps that have to be; on return those that have been reached
   */
  template <int dim>
  void
  Contacts<dim>::displace(const std::vector<Gap> &gaps,
                          std::vector<bool>      &exact,
                          Configuration<dim>     &configuration) const
  {
    std::vector<unsigned int> near;
    for (unsigned int p = 0; p < gaps.size(); ++p)
      if (gaps[p].excess < reach)
        near.push_back(p);

    const unsigned int  n = bodies.n_unknowns();
    FullMatrix<double>  rates(near.size(), n);
    std::vector<double> missing;
    std::vector<bool>   bilateral;
    for (unsigned int c = 0; c < near.size(); ++c)
      {
        const std::vector<double> rate = gaps[near[c]].contact.rate(bodies);
        for (unsigned int k = 0; k < n; ++k)
          rates(c, k) = rate[k];
        missing.push_back(-gaps[near[c]].excess);
        bilateral.push_back(exact[near[c]]);
      }

    const auto solution = displacements.solve(rates,
                                              missing,
                                              std::vector<double>(n, 0.),
                                              bilateral);
    for (unsigned int k = 0; k < n; ++k)
      if (!bodies.unknown(k).rotation)
        configuration
          .centres[bodies.unknown(k).particle][bodies.unknown(k).axis] +=
          solution.motion[k];
    for (unsigned int c = 0; c < near.size(); ++c)
      exact[near[c]] = solution.active[c];
  }



  template <int dim>
  void
  Contacts<dim>::remember(const std::vector<Contact<dim>> &contacts,
                          const std::vector<double>       &forces)
  {
    AssertDimension(contacts.size(), forces.size());
    held.clear();
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (forces[c] > 0.)
        held.push_back({contacts[c], forces[c]});
  }



  template <int dim>
  double
  Contacts<dim>::last_force(const Contact<dim> &contact) const
  {
    // those of a pair of equal spheres are at least 60 degrees apart
    constexpr double cos_of_same = 0.9;
    for (const HeldContact &other : held)
      if (contact.i == other.contact.i && contact.j == other.contact.j &&
          contact.partner == other.contact.partner)
        for (const bool turned : {false, true})
          if (contact.direction *
                  Image<dim>{turned}.turn(other.contact.direction) >
                cos_of_same &&
              (!turned || scene.rotational()))
            return other.force;
    return 0.;
  }



  template <int dim>
  std::vector<double>
  Contacts<dim>::remembered_forces(
    const std::vector<Contact<dim>> &contacts) const
  {
    std::vector<double> forces;
    for (const Contact<dim> &contact : contacts)
      forces.push_back(last_force(contact));
    return forces;
  }



  template <int dim>
  double
  Contacts<dim>::smallest_gap(const Configuration<dim> &configuration) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Pair &pair : pairs)
      if (pair.partner == Contact<dim>::Partner::particle)
        smallest = std::min(smallest,
                            gap(configuration, pair).excess / 2. + minimal_gap);
    return smallest;
  }



  template struct Contact<2>;
  template struct Contact<3>;
  template std::vector<double>
  forces_on_particles<2>(const std::vector<Contact<2>> &,
                         const std::vector<double> &,
                         const RigidBodies<2> &);
  template std::vector<double>
  forces_on_particles<3>(const std::vector<Contact<3>> &,
                         const std::vector<double> &,
                         const RigidBodies<3> &);
  template class Contacts<2>;
  template class Contacts<3>;
} // namespace Catena

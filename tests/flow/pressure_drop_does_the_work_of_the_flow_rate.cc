// A flow driven by pressure has a mean velocity of 1 through the section of the
// channel, particles included, and the pressure drop is what it takes:
//
// - an empty channel: the parabola, and P = 12 L/H^2;
// - particles held or free: P times the section is the friction on the walls
//   plus the force on what is held, and P Q is the power dissipated;
// - a free disc on the axis is faster than the mean, slower than the parabola.

#include "../tests.h"

#include "../print.h"
#include "stokes_problem.h"

using namespace dealii;
using namespace Catena;

template <int dim>
class Driven : public Tests::StokesProblem<dim>
{
public:
  Driven(const Scene<dim> &scene, const MeshParameters &mesh)
    : Tests::StokesProblem<dim>(scene, mesh)
  {
    this->configuration.shear_rate = 0.;
    this->solve();
    find_integrals();
  }

  /// Mean of u_x over the box with its particles, power dissipated, force
  /// along x on the walls, and volume of the meshed fluid and the particles,
  /// which is that of the box but for the polynomial surfaces.
  double mean = 0., power = 0., friction = 0., volume = 0.;

private:
  void
  find_integrals()
  {
    const Scene<dim> &scene = this->mesh.scene();
    CellValues<dim>   values;
    double            flux = 0.;
    for (const auto &cell : this->mesh.cells())
      {
        values.reinit(this->mesh.cell_positions(cell, this->mesh.positions()),
                      cell.curved);
        for (const auto &point : values.points())
          {
            volume += point.JxW;
            Tensor<2, dim> L;
            for (unsigned int a = 0; a < this->mesh.n_nodes; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double u =
                    this->fields.velocity(dim * cell.nodes[a] + d);
                  L[d] += u * point.quadratic_gradient[a];
                  if (d == 0)
                    flux += point.JxW * u * point.quadratic[a];
                }
            power += 2. * point.JxW * (symmetrize(L) * symmetrize(L));
          }
      }
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      {
        const unsigned int k = this->bodies.range(i).first;
        const double       displaced =
          this->bodies.meshed_share(k) * this->bodies.displaced_volume(k);
        flux += displaced * this->fields.motions[i].velocity[0];
        volume += displaced;
      }
    mean = flux / (scene.length * scene.section());

    const double pressure_gradient = this->fields.pressure_drop / scene.length;
    const auto   reactions         = Tests::nodal_reactions(*this);
    std::vector<double> volumes(this->mesh.n_global_nodes(), 0.);
    for (const auto &cell : this->mesh.cells())
      {
        values.reinit(this->mesh.cell_positions(cell, this->mesh.positions()),
                      cell.curved);
        for (const auto &point : values.points())
          for (unsigned int a = 0; a < this->mesh.n_nodes; ++a)
            volumes[cell.nodes[a]] += point.JxW * point.quadratic[a];
      }
    for (const auto node : this->mesh.owned_nodes())
      if (this->mesh.on_wall(node))
        friction -= reactions[node][0] - pressure_gradient * volumes[node];
  }
};



void
claim_balance(Tests::Claims     &claims,
              const std::string &name,
              const Driven<2>   &flow)
{
  const Scene<2> &scene = flow.mesh.scene();
  const double    drop  = flow.fields.pressure_drop;
  // forces() is what holds the particles
  const std::vector<double> forces = flow.forces();
  double                    drag   = 0.;
  for (unsigned int k = 0; k < forces.size(); ++k)
    if (flow.bodies.displaced_volume(k) > 0.)
      drag -= forces[k];
  Tests::print(name, ": pressure drop ", drop, ", drag ", drag);
  claims.near(name + ": the mean velocity is 1", flow.mean, 1., 1e-8);
  claims.near(name + ": the pressure drop balances friction and drag",
              (flow.friction + drag) / (drop / scene.length * flow.volume),
              1.,
              1e-9);
  claims.near(name + ": it does the work that is dissipated",
              flow.power / (drop * scene.section()),
              1.,
              1e-9);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    MeshParameters mesh;
    mesh.elements_on_equator = 32;
    mesh.maximal_size        = 0.5;

    Scene<2> scene;
    scene.length = 10.;
    scene.height = 4.;
    scene.drive  = Drive::pressure;
    {
      const Driven<2> empty(scene, mesh);
      double          error = 0.;
      for (const auto node : empty.mesh.owned_nodes())
        {
          const double y = empty.position(node)[1] / 2.;
          error          = std::max(error,
                           std::abs(empty.fields.velocity(2 * node) -
                                    1.5 * (1. - y * y)));
        }
      claims.at_most("empty channel: the velocity is a parabola", error, 1e-8);
      claims.near("empty channel: the pressure drop is exact",
                  empty.fields.pressure_drop,
                  12. * scene.length / (scene.height * scene.height),
                  1e-7);
      claim_balance(claims, "empty channel", empty);
    }

    Particle<2> disc;
    disc.fixed      = true;
    scene.particles = {disc};
    const Driven<2> fixed(scene, mesh);
    claim_balance(claims, "fixed disc", fixed);
    claims.at_most("fixed disc: it stays where it is",
                   fixed.fields.motions[0].velocity.norm() +
                     fixed.fields.motions[0].angular_velocity.norm(),
                   0.);

    disc.fixed      = false;
    scene.particles = {disc};
    const Driven<2> free(scene, mesh);
    claim_balance(claims, "free disc", free);
    claims.at_least("free disc: it is faster than the mean",
                    free.fields.motions[0].velocity[0],
                    1.);
    claims.at_most("free disc: it is slower than the parabola",
                   free.fields.motions[0].velocity[0],
                   1.5);
    claims.at_least("free disc: it takes less pressure than a fixed one",
                    fixed.fields.pressure_drop / free.fields.pressure_drop,
                    1.2);

    // one across the period, beside a fixed one
    disc.centre = Point<2>(4.6, 0.7);
    Particle<2> other;
    other.fixed     = true;
    other.centre    = Point<2>(0.4, -0.6);
    scene.particles = {disc, other};
    const Driven<2> two(scene, mesh);
    claim_balance(claims, "free disc beside a fixed one", two);

    Scene<3> channel;
    channel.length           = 6.;
    channel.height           = 4.;
    channel.width            = 4.;
    channel.symmetry         = Symmetry::half;
    channel.drive            = Drive::pressure;
    channel.particles        = {{Point<3>(0., 0.5, 0.)}};
    mesh.elements_on_equator = 16;
    const Driven<3> sphere(channel, mesh);
    claims.near("half of a channel with a sphere: the mean velocity is 1",
                sphere.mean,
                1.,
                1e-8);
    claims.near("half of a channel with a sphere: the work is dissipated",
                sphere.power /
                  (sphere.fields.pressure_drop * channel.section()),
                1.,
                1e-7);
  });
}

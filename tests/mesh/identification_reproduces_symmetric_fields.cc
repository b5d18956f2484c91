// A vector and a tensor field that are periodic, and by construction the same
// after half a turn about z, have at every node the value at its master times
// the factors of NodeIdentification, for both cuts of the box. Every node on an
// identified plane has its image, and the axes of the rotation are found.

#include <catena/mesh/moving_mesh.h>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;

/// Some smooth field with the period of the scene, different for each i.
template <int dim>
double
wave(const Scene<dim> &scene, const Point<dim> &p, const unsigned int i)
{
  const double k = 2. * numbers::PI / scene.length;
  const double z = dim == 3 ? p[dim - 1] : 0.;
  return std::cos(k * p[0] + 0.3 + i) * std::cos(0.1 * p[1] + 0.2 * i) +
         std::sin(2. * k * p[0] - 0.4 * i) * (0.05 * p[1] + 0.03 * z + 0.5);
}



template <int dim>
Point<dim>
half_turn(const Point<dim> &p)
{
  Point<dim> q = p;
  q[0]         = -p[0];
  q[1]         = -p[1];
  return q;
}



/// Factor of component d of a vector under half a turn about z.
double
sign(const unsigned int d)
{
  return d < 2 ? -1. : 1.;
}



template <int dim>
Tensor<1, dim>
vector_field(const Scene<dim> &scene, const Point<dim> &p, const bool symmetric)
{
  Tensor<1, dim> v;
  for (unsigned int d = 0; d < dim; ++d)
    {
      v[d] = wave(scene, p, d);
      if (symmetric)
        v[d] += sign(d) * wave(scene, half_turn(p), d);
    }
  return v;
}



template <int dim>
SymmetricTensor<2, dim>
tensor_field(const Scene<dim> &scene, const Point<dim> &p, const bool symmetric)
{
  SymmetricTensor<2, dim> t;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      {
        t[i][j] = wave(scene, p, 3 + i + 2 * j);
        if (symmetric)
          t[i][j] +=
            sign(i) * sign(j) * wave(scene, half_turn(p), 3 + i + 2 * j);
      }
  return t;
}



/// Largest difference between the fields and what their masters tell.
struct Deviation
{
  double vector = 0., tensor = 0.;
};



template <int dim>
Deviation
deviation(const Scene<dim>              &scene,
          const std::vector<Point<dim>> &points,
          const NodeIdentification      &identification,
          const bool                     symmetric)
{
  Deviation result;
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      const Point<dim> &p = points[i], &q = points[identification.master(i)];
      const auto        v = vector_field(scene, p, symmetric),
                 master_v = vector_field(scene, q, symmetric);
      const auto t        = tensor_field(scene, p, symmetric),
                 master_t = tensor_field(scene, q, symmetric);
      for (unsigned int d = 0; d < dim; ++d)
        result.vector =
          std::max(result.vector,
                   std::abs(v[d] -
                            identification.vector_factor(i, d) * master_v[d]));
      for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
        result.tensor =
          std::max(result.tensor,
                   std::abs(t.access_raw_entry(k) -
                            identification.template tensor_factor<dim>(i, k) *
                              master_t.access_raw_entry(k)));
    }
  return result;
}



/// A multiple of the period or of half of it?
bool
is_multiple(const double x, const double period)
{
  return std::abs(std::remainder(x, period)) < 1e-6;
}



/**
 * Nodes whose master is not where it should be, or that have no master beside
 * themselves on an identified plane.
 */
template <int dim>
unsigned int
n_wrong_nodes(const MovingMesh<dim>         &mesh,
              const std::vector<Point<dim>> &points)
{
  const Scene<dim>         &scene          = mesh.scene();
  const NodeIdentification &identification = mesh.identification();

  std::vector<unsigned int> n_images(points.size(), 0);
  for (unsigned int i = 0; i < points.size(); ++i)
    ++n_images[identification.master(i)];

  unsigned int n_wrong = 0;
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      const Point<dim> &p = points[i];
      Point<dim>        q = points[identification.master(i)];
      if (identification.turned(i))
        q = half_turn(q);
      bool is_image = is_multiple(p[0] - q[0], scene.length);
      for (unsigned int d = 1; d < dim; ++d)
        is_image &= std::abs(p[d] - q[d]) < 1e-6;

      bool identified = false;
      for (const auto &pair : scene.identifications())
        identified |=
          mesh.on_boundary(i, pair.from) || mesh.on_boundary(i, pair.to);
      const bool on_axis = scene.rotational() && std::abs(p[1]) < 1e-6 &&
                           is_multiple(p[0], scene.length / 2.);
      const bool has_images = n_images[identification.master(i)] > 1;

      const bool right =
        is_image && on_axis == identification.on_axis(i) &&
        (identified ? has_images || on_axis : !has_images && !on_axis);
      n_wrong += right ? 0 : 1;
    }
  return n_wrong;
}



template <int dim>
void
check(Tests::Claims &claims, const std::string &name, const Scene<dim> &scene)
{
  const MovingMesh<dim>   mesh(MPI_COMM_WORLD,
                             scene,
                             generate_mesh(scene, Tests::resolution(16, 1)));
  std::vector<Point<dim>> points(mesh.n_global_nodes());
  for (unsigned int i = 0; i < points.size(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      points[i][d] = mesh.positions()(dim * i + d);

  const std::string title = name + " (" + std::to_string(dim) + "D): ";
  claims.holds(title + "every node has its master",
               n_wrong_nodes(mesh, points) == 0);

  const Deviation symmetric =
    deviation(scene, points, mesh.identification(), scene.rotational());
  claims.at_most(title + "a symmetric vector field is reproduced",
                 symmetric.vector,
                 1e-12);
  claims.at_most(title + "a symmetric tensor field is reproduced",
                 symmetric.tensor,
                 1e-12);
  if (!scene.rotational())
    return;
  const Deviation other =
    deviation(scene, points, mesh.identification(), false);
  claims.at_least(title + "a field without symmetry is not",
                  std::min(other.vector, other.tensor),
                  0.1);
}



template <int dim>
void
check_all(Tests::Claims &claims)
{
  check(claims, "no symmetry", Tests::two_particles<dim>(Symmetry::none, 3.));
  if (dim == 3)
    check(claims, "half", Tests::two_particles<dim>(Symmetry::half, 3.));
  check(claims, "cut at x = 0", Tests::three_particles<dim>(3., 10.));

  auto scene = Tests::three_particles<dim>(3., 80., Cut::y_plane);
  check(claims, "cut at y = 0", scene);
  scene.window_centre = 10.;
  check(claims, "cut at y = 0, window moved up", scene);
  scene.window_centre = -7.3;
  check(claims, "cut at y = 0, window moved down", scene);
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    check_all<2>(claims);
    check_all<3>(claims);
  });
}

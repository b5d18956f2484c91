// The projection of a conformation with steep layers beside the particles, from
// one mesh of a cut domain to another, conserves its integral, which
// interpolation does not; it is of second order, and what is P1 already stays.

#include <catena/conformation/entropy_projection.h>
#include <catena/mesh/field_transfer.h>
#include <catena/rheology/spectral.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "fields.h"

using namespace dealii;
using namespace Catena;
using namespace Catena::Tests;

/// s along the normals of the particles, with the symmetries of the scene
template <int dim>
SymmetricTensor<2, dim>
layer(const Scene<dim> &scene, const Point<dim> &x)
{
  SymmetricTensor<2, dim> s;
  for (const Particle<dim> &particle : scene.particles)
    for (const Image<dim> &image : scene.images())
      {
        if (particle.on_axis && image.turned)
          continue;
        const Tensor<1, dim> arm = x - image(particle.centre);
        const double         r   = arm.norm();
        s += 3. * std::exp(-(r - 1.) / 0.3) / (r * r) *
             (symmetrize(outer_product(arm, arm)) -
              0.3 * r * r * unit_symmetric_tensor<dim>());
      }
  return s;
}



template <int dim>
SymmetricTensor<2, dim>
exponential_of(const SymmetricTensor<2, dim> &s)
{
  return exponential<dim>(spectral_decomposition<dim>(s));
}



/**
 * Integral of the conformation, with the quadrature of the flow, without the
 * components that are odd under reflection at a mirror plane: they are not free
 * there.
 */
template <int dim>
SymmetricTensor<2, dim>
integral(const MovingMesh<dim>                      &mesh,
         const std::vector<SymmetricTensor<2, dim>> &conformation)
{
  SymmetricTensor<2, dim> sum;
  CellValues<dim>         values;
  auto                    c = conformation.begin();
  for (const auto &cell : mesh.cells())
    {
      values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
      for (const auto &point : values.points())
        {
          if (cell.owned)
            sum += point.JxW * (*c - unit_symmetric_tensor<dim>());
          ++c;
        }
    }
  if constexpr (dim == 3)
    sum[0][2] = sum[1][2] = 0.;
  return Utilities::MPI::sum(sum, mesh.communicator());
}



template <int dim>
std::vector<SymmetricTensor<2, dim>>
at_points(const MovingMesh<dim> &mesh, const std::vector<VectorType> &field)
{
  std::vector<SymmetricTensor<2, dim>> result;
  CellValues<dim>                      values;
  for (const auto &cell : mesh.cells())
    {
      const auto s = vertex_tensors<dim>(cell, field);
      values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
      for (const auto &point : values.points())
        {
          SymmetricTensor<2, dim> s_q;
          for (unsigned int v = 0; v < s.size(); ++v)
            s_q += point.linear[v] * s[v];
          result.push_back(exponential_of<dim>(s_q));
        }
    }
  return result;
}



template <int dim>
void
check(Claims &claims, const Scene<dim> &scene, const std::string &name)
{
  const auto exact = [&scene](const Point<dim> &x) {
    return layer<dim>(scene, x);
  };
  const auto make = [&scene](const unsigned int on_equator) {
    MeshParameters parameters;
    parameters.elements_on_equator = on_equator;
    parameters.elements_across_gap = 1;
    return std::make_unique<MovingMesh<dim>>(
      MPI_COMM_WORLD, scene, generate_mesh<dim>(scene, parameters));
  };
  const auto excess = [](const auto &changed, const auto &original) {
    return (changed - original).norm() / original.norm();
  };

  std::vector<double> errors, sizes;
  for (const unsigned int n : {16, 32})
    {
      const auto mesh_pointer       = make(dim == 2 ? 2 * n : n),
                 old_pointer        = make(dim == 2 ? 3 * n : n + 6);
      const auto              &mesh = *mesh_pointer, &old = *old_pointer;
      const FieldTransfer<dim> transfer(old,
                                        old.positions(),
                                        mesh,
                                        mesh.positions());
      const auto s = interpolate_tensor<dim>(old, old.positions(), exact);
      const auto conformation =
        transfer
          .conserved_at_points(s, exponential_of<dim>, PointTensors<dim>())
          .of_field;
      const auto guess = transfer.tensor(s);

      EntropyProjection<dim> projection(mesh, mesh.positions());
      const auto        projected = projection.project(conformation, guess);
      const auto        expected  = integral(mesh, conformation);
      const std::string on        = name + ", " + std::to_string(n);
      claims.at_most(on + ": the integral of c - I is conserved",
                     excess(integral(mesh, at_points(mesh, projected)),
                            expected),
                     1e-4);
      claims.at_least(on + ": interpolation does not conserve it",
                      excess(integral(mesh, at_points(mesh, guess)), expected),
                      1e-2);

      const auto again =
        projection.project(at_points(mesh, projected),
                           std::vector<VectorType>(guess.size(),
                                                   mesh.scalar_field()));
      double difference = 0.;
      for (unsigned int k = 0; k < again.size(); ++k)
        for (const auto i : mesh.owned_scalars())
          difference =
            std::max(difference, std::abs(again[k](i) - projected[k](i)));
      claims.at_most(on + ": what is P1 already stays, from any first guess",
                     Utilities::MPI::max(difference, mesh.communicator()),
                     1e-3);
      errors.push_back(mean_error<dim>(mesh, projected, exact));
      sizes.push_back(std::pow(mesh.scalar_dofs().n_dofs(), -1. / dim));
    }
  claims.at_least(name + ": order of the error in s, by unknowns",
                  std::log(errors[0] / errors[1]) /
                    std::log(sizes[0] / sizes[1]),
                  2.);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    check<2>(claims, three_particles<2>(2.3), "discs");
    check<3>(claims, two_particles<3>(Symmetry::half, 2.3), "half");
    check<3>(claims, three_particles<3>(2.3), "quarter");
  });
}

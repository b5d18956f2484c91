// The flow's products without a matrix against the bilinear form, integrated
// over the cells with the fields that the unknowns stand for; transposed, and
// in single precision. The fluid has a tensor viscosity and a tangent that
// differ from point to point.

#include <catena/base/replicated.h>
#include <catena/flow/flow_assembly.h>
#include <catena/flow/flow_operator.h>
#include <catena/flow/flow_unknowns.h>
#include <catena/flow/velocity_constraints.h>

#include <cmath>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "stokes_problem.h"

using namespace Catena;
using namespace dealii;

namespace
{
  /// Any coefficients that the points of a cell can tell from each other.
  template <int dim>
  class AnyStress : public StressModel<dim>
  {
  public:
    explicit AnyStress(const MovingMesh<dim> &mesh)
      : mesh(mesh)
    {}

    bool
    has_tangent() const override
    {
      return true;
    }

    void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override
    {
      const auto positions = mesh.cell_positions(cell, mesh.positions());
      coefficients.clear();
      for (const auto &point : values.points())
        {
          const Point<dim>        x = position_at<dim>(point, positions);
          StressCoefficients<dim> c;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j <= i; ++j)
              {
                c.viscosity[i][j] =
                  (i == j ? 2. : 0.) + 0.5 * std::sin(x[i] + 2. * x[j]);
                c.tangent[i][j] = std::cos(2. * x[i] - x[j]);
              }
          c.tangent_factor = -0.2 - 0.1 * std::sin(x[0]);
          coefficients.push_back(c);
        }
    }

  private:
    const MovingMesh<dim> &mesh;
  };



  /// int (L H + H L^T + k (B:L) B - p I) : grad v - q div u
  template <int dim>
  double
  bilinear_form(const MovingMesh<dim>  &mesh,
                const StressModel<dim> &stress,
                const FlowFields<dim>  &u,
                const FlowFields<dim>  &v)
  {
    double                               sum = 0.;
    CellValues<dim>                      values;
    std::vector<StressCoefficients<dim>> coefficients;
    for (const auto &cell : mesh.cells())
      if (cell.owned)
        {
          values.reinit(mesh.cell_positions(cell, mesh.positions()),
                        cell.curved);
          stress.evaluate(cell, values, coefficients);
          const auto of_u = node_vectors<dim>(cell, u.velocity),
                     of_v = node_vectors<dim>(cell, v.velocity);
          for (unsigned int q = 0; q < coefficients.size(); ++q)
            {
              const auto          &point = values.points()[q];
              const Tensor<2, dim> L     = gradient_at<dim>(point, of_u),
                                   G     = gradient_at<dim>(point, of_v);
              double p = 0., test = 0.;
              for (unsigned int i = 0; i < mesh.n_vertices; ++i)
                {
                  p += u.pressure(cell.vertices[i]) * point.linear[i];
                  test += v.pressure(cell.vertices[i]) * point.linear[i];
                }
              coefficients[q].known_stress = 0.;
              sum += point.JxW * (coefficients[q].stress(L) * symmetrize(G) -
                                  p * trace(G) - test * trace(L));
            }
        }
    return Utilities::MPI::sum(sum, mesh.communicator());
  }



  template <int dim>
  void
  test(Tests::Claims &claims)
  {
    const auto                      scene = Tests::three_particles<dim>();
    const Tests::StokesProblem<dim> problem(scene, Tests::resolution(12, 1));
    const auto                      couplings =
      node_couplings<dim>(problem.mesh,
                          velocity_constraints<dim>(problem.mesh,
                                                    problem.bodies,
                                                    problem.configuration,
                                                    false));
    const AnyStress<dim> stress(problem.mesh);
    FlowSystem<dim>      system(problem.mesh, problem.bodies, couplings);
    assemble_flow<dim>(problem.mesh,
                       couplings,
                       stress,
                       scene.imposed_gradient(),
                       system,
                       nullptr);
    const FlowUnknowns<dim> unknowns{problem.mesh,
                                     problem.bodies,
                                     problem.configuration,
                                     false,
                                     couplings,
                                     system};

    // values of what is solved for
    const auto any_vector = [&](const double shift) {
      BlockVectorType x = unknowns.make_vector(0);
      for (const auto node : problem.mesh.owned_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          if (couplings[node].master == node &&
              couplings[node].factors[d] != 0.)
            x.block(0)(dim * node + d) =
              std::sin(shift + 0.7 * (dim * node + d));
      for (const auto vertex : problem.mesh.owned_scalars())
        if (problem.mesh.vertex_master(vertex) == vertex)
          x.block(1)(vertex) = std::cos(shift + vertex);
      for (const auto k : x.block(2).locally_owned_elements())
        x.block(2)(k) = 1. + shift + k;
      return x;
    };
    const BlockVectorType x = any_vector(0.), y = any_vector(1.);
    const auto            fields = [&](const BlockVectorType &vector) {
      FlowFields<dim> result, at_rest;
      unknowns.extract(vector, {}, result);
      unknowns.extract(unknowns.make_vector(0), {}, at_rest);
      result.velocity -= at_rest.velocity;
      result.velocity.update_ghost_values();
      return result;
    };

    const ContactBlocks             no_contacts;
    const FlowOperator<dim, double> whole_system{system, no_contacts};
    const FlowOperator<dim, float>  fast_system{system, no_contacts};
    BlockVectorType                 product(x), mixed_product(x);
    FastBlockVectorType             fast_x, fast_product;
    fast_x = x;
    fast_product.reinit(fast_x);
    whole_system.vmult(product, x);
    fast_system.vmult(mixed_product, x);
    fast_system.vmult(fast_product, fast_x);
    const double      scale = y.l2_norm() * product.l2_norm();
    const std::string in    = ", dim = " + std::to_string(dim);
    claims.near("the product is the bilinear form" + in,
                (y * product) / scale,
                bilinear_form(problem.mesh, stress, fields(x), fields(y)) /
                  scale,
                1e-12);
    mixed_product -= product;
    claims.at_most("single precision leaves its rounding" + in,
                   mixed_product.l2_norm() / product.l2_norm(),
                   1e-6);
    BlockVectorType difference(x);
    difference = fast_product;
    difference -= product;
    claims.at_most("as it does with vectors that have it" + in,
                   difference.l2_norm() / product.l2_norm(),
                   1e-6);

    FastBlockVectorType fast_y, transposed;
    fast_y = y;
    transposed.reinit(fast_x);
    std::vector<double>       forces;
    const std::vector<double> motions = replicate(y.block(2));
    system.Tvmult({transposed.block(0), transposed.block(1), forces},
                  {fast_y.block(0), fast_y.block(1), motions});
    set_replicated(transposed.block(2), forces);
    difference = transposed;
    claims.near("so is the transposed one" + in,
                (x * difference) / scale,
                (y * product) / scale,
                1e-6);

    // with x = 0 in part: blocks that are easily mistaken for one another
    BlockVectorType pressure(x);
    pressure.block(0) = 0.;
    pressure.block(2) = 0.;
    whole_system.vmult(product, pressure);
    claims.near(
      "a pressure acts on the nodes and the particles" + in,
      (y * product) / scale,
      bilinear_form(problem.mesh, stress, fields(pressure), fields(y)) / scale,
      1e-12);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    test<2>(claims);
    test<3>(claims);
  });
}

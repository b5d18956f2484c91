// The flow's products without a matrix against the bilinear form, integrated
// over the cells with the fields that the unknowns stand for; transposed, and
// in single precision. The fluid has a viscosity, a tensor or a scalar, and a
// tangent that differ from point to point.

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
    AnyStress(const MovingMesh<dim> &mesh, const bool scalar_viscosity)
      : mesh(mesh)
      , scalar_viscosity(scalar_viscosity)
    {}

    bool
    has_scalar_viscosity() const override
    {
      return scalar_viscosity;
    }

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
          if (scalar_viscosity)
            c.viscosity = c.viscosity[0][0] * unit_symmetric_tensor<dim>();
          c.tangent_factor = -0.2 - 0.1 * std::sin(x[0]);
          coefficients.push_back(c);
        }
    }

  private:
    const MovingMesh<dim> &mesh;
    const bool             scalar_viscosity;
  };



  /// Its viscosity is said to be a scalar, which it is not.
  class WrongStress : public NewtonianStress<2>
  {
  public:
    void
    evaluate(const MovingMesh<2>::Cell          &cell,
             const CellValues<2>                &values,
             std::vector<StressCoefficients<2>> &coefficients) const override
    {
      NewtonianStress<2>::evaluate(cell, values, coefficients);
      for (auto &point : coefficients)
        point.viscosity[0][1] = 0.1;
    }
  };



  bool
  is_refused(const StressModel<2> &stress)
  {
    Tests::StokesProblem<2> problem(Tests::three_particles<2>(),
                                    Tests::resolution(12, 1));
    try
      {
        problem.solver.assemble(problem.configuration, stress);
      }
    catch (const ExceptionBase &)
      {
        return true;
      }
    return false;
  }



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



  /// -P/L (int v_x + sum_i V_i V_i,x) and the same of Q, for the unknowns x and
  /// y whose last motion is P, and Q.
  template <int dim, typename Fields>
  double
  work_of_the_drop(const RigidBodies<dim> &bodies,
                   const MovingMesh<dim>  &mesh,
                   const BlockVectorType  &x,
                   const BlockVectorType  &y,
                   const Fields           &fields)
  {
    if (!mesh.scene().pressure_driven())
      return 0.;
    const auto flow_rate = [&](const BlockVectorType &vector) {
      const FlowFields<dim> u   = fields(vector);
      double                sum = 0.;
      CellValues<dim>       values;
      for (const auto &cell : mesh.cells())
        if (cell.owned)
          {
            values.reinit(mesh.cell_positions(cell, mesh.positions()),
                          cell.curved);
            const auto at_nodes = node_vectors<dim>(cell, u.velocity);
            for (const auto &point : values.points())
              sum += point.JxW * (point.quadratic * at_nodes.components[0]);
          }
      sum = Utilities::MPI::sum(sum, mesh.communicator());
      const std::vector<double> motions = replicate(vector.block(2));
      for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
        sum += bodies.meshed_share(k) * bodies.displaced_volume(k) * motions[k];
      return sum / mesh.scene().length;
    };
    return -replicate(x.block(2)).back() * flow_rate(y) -
           replicate(y.block(2)).back() * flow_rate(x);
  }



  template <int dim>
  void
  test(Tests::Claims     &claims,
       const Scene<dim>  &scene,
       const std::string &name,
       const bool         scalar_viscosity = false)
  {
    const Tests::StokesProblem<dim> problem(scene, Tests::resolution(12, 1));
    const MovingMesh<dim>          &mesh = problem.mesh;
    const auto                      couplings =
      node_couplings<dim>(mesh,
                          velocity_constraints<dim>(mesh,
                                                    problem.bodies,
                                                    problem.configuration,
                                                    false));
    const AnyStress<dim>        stress(mesh, scalar_viscosity);
    FlowSystem<dim>             system(mesh, problem.bodies, couplings);
    PreconditionerMatrices<dim> matrices(mesh, couplings);
    // without a tangent before
    assemble_flow<dim>(NewtonianStress<dim>(),
                       scene.imposed_gradient(),
                       system,
                       nullptr);
    assemble_flow<dim>(stress, scene.imposed_gradient(), system, &matrices);
    const FlowUnknowns<dim> unknowns{
      mesh, problem.bodies, problem.configuration, false, couplings, system};
    const bool any_rigid = system.n_rigid() > 0;

    // values of what is solved for, or of what is not
    const auto any_vector = [&](const double shift, const bool solved) {
      BlockVectorType x = unknowns.make_vector(0);
      for (const auto node : mesh.owned_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          if (couplings[node].is_unknown(node, d) == solved)
            x.block(0)(dim * node + d) =
              std::sin(shift + 0.7 * (dim * node + d));
      for (const auto vertex : mesh.owned_scalars())
        if (solved && mesh.vertex_master(vertex) == vertex)
          x.block(1)(vertex) = std::cos(shift + vertex);
      if (any_rigid)
        for (const auto k : x.block(2).locally_owned_elements())
          if ((k == problem.bodies.n_unknowns() || problem.bodies.is_free(k)) ==
              solved)
            x.block(2)(k) = 1. + shift + k;
      return x;
    };
    const auto fields = [&](const BlockVectorType &vector) {
      FlowFields<dim> result, at_rest;
      unknowns.extract(vector, {}, result);
      unknowns.extract(unknowns.make_vector(0), {}, at_rest);
      result.velocity -= at_rest.velocity;
      result.velocity.update_ghost_values();
      return result;
    };

    const BlockVectorType           x = any_vector(0., true);
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

    for (const double shift : {1., 2., 3.})
      {
        const BlockVectorType y     = any_vector(shift, true);
        const double          scale = y.l2_norm() * product.l2_norm();
        claims.near(name + ": the product is the bilinear form",
                    (y * product) / scale,
                    (bilinear_form(mesh, stress, fields(x), fields(y)) +
                     work_of_the_drop(problem.bodies, mesh, x, y, fields)) /
                      scale,
                    1e-12);

        FastBlockVectorType fast_y, transposed;
        fast_y = y;
        transposed.reinit(fast_x);
        std::vector<double> forces, motions;
        if (any_rigid)
          motions = replicate(y.block(2));
        system.Tvmult({transposed.block(0), transposed.block(1), forces},
                      {fast_y.block(0), fast_y.block(1), motions});
        if (any_rigid)
          set_replicated(transposed.block(2), forces);
        BlockVectorType whole(x);
        whole = transposed;
        claims.near(name + ": so is the transposed one",
                    (x * whole) / scale,
                    (y * product) / scale,
                    1e-6);
      }

    mixed_product -= product;
    claims.at_most(name + ": single precision leaves its rounding",
                   mixed_product.l2_norm() / product.l2_norm(),
                   1e-6);
    BlockVectorType difference(x);
    difference = fast_product;
    difference -= product;
    claims.at_most(name + ": as it does with vectors that have it",
                   difference.l2_norm() / product.l2_norm(),
                   1e-6);

    const BlockVectorType known = any_vector(0., false);
    whole_system.vmult(product, known);
    product -= known;
    claims.at_most(name + ": what is known is its own value",
                   product.linfty_norm(),
                   0.);

    FastVectorType forces, pressure;
    forces.reinit(fast_product.block(0));
    pressure = x.block(1);
    matrices.gradient.vmult(forces, pressure);
    fast_x          = 0.f;
    fast_x.block(1) = pressure;
    fast_system.vmult(fast_product, fast_x);
    fast_product.block(0) -= forces;
    claims.at_most(name + ": the gradient is that of the preconditioner",
                   fast_product.block(0).l2_norm() / forces.l2_norm(),
                   1e-6);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    test<2>(claims, Tests::three_particles<2>(), "2D");
    test<3>(claims, Tests::three_particles<3>(), "3D");
    test<2>(claims, Tests::three_particles<2>(), "2D, scalar viscosity", true);
    test<3>(claims, Tests::three_particles<3>(), "3D, scalar viscosity", true);

    Scene<2> alone;
    alone.length = 6.;
    alone.height = 4.;
    test<2>(claims, alone, "no particles");

    // one across the period, beside a fixed one
    Particle<2> disc, other;
    disc.centre       = Point<2>(4.6, 0.7);
    other.fixed       = true;
    other.centre      = Point<2>(0.4, -0.6);
    Scene<2> channel  = alone;
    channel.drive     = Drive::pressure;
    channel.particles = {disc, other};
    for (auto &particle : channel.particles)
      particle.radius = 0.5;
    test<2>(claims, channel, "channel");

    claims.holds("a tensor that is said to be a scalar is refused",
                 is_refused(WrongStress()));
  });
}

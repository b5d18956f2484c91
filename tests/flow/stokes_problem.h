#ifndef catena_tests_flow_stokes_problem_h
#define catena_tests_flow_stokes_problem_h

#include <catena/flow/flow_solver.h>
#include <catena/flow/particle_forces.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/mesher.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    /**
     * A scene meshed and its flow in a Newtonian fluid at one instant, with
     * all that a solve needs.
     */
    template <int dim>
    class StokesProblem
    {
    public:
      StokesProblem(const Scene<dim>     &scene,
                    const MeshParameters &parameters,
                    const double          tolerance = 1e-10)
        : StokesProblem(scene, generate_mesh(scene, parameters), tolerance)
      {}

      /// On a given mesh.
      StokesProblem(const Scene<dim>           &scene,
                    const MeshDescription<dim> &description,
                    const double                tolerance      = 1e-10,
                    const unsigned int          max_iterations = 300)
        : mesh(MPI_COMM_WORLD, scene, description)
        , bodies(scene)
        , solver(controls(tolerance, max_iterations))
      {
        scene.check();
        for (const auto &particle : scene.particles)
          configuration.centres.push_back(particle.centre);
        solver.reinit(mesh, bodies, configuration, false);

        fields.velocity = mesh.vector_field();
        for (const auto node : mesh.owned_nodes())
          {
            const auto u = Scene<dim>::imposed_velocity(position(node));
            for (unsigned int d = 0; d < dim; ++d)
              fields.velocity(dim * node + d) = u[d];
          }
        fields.velocity.update_ghost_values();
        fields.pressure = mesh.scalar_field();
        fields.motions.resize(scene.particles.size());
      }

      /// Free particles in a fluid under a force per volume.
      unsigned int
      solve(const dealii::Function<dim> *body_force = nullptr)
      {
        solver.assemble(configuration, stress, body_force);
        return solver.solve(fields,
                            {},
                            std::vector<double>(bodies.n_unknowns(), 0.));
      }

      /// Forces and torques on the particles, by rigid-body unknown.
      unsigned int
      solve(const std::vector<double>       &external_forces,
            const std::vector<Contact<dim>> &candidates = {})
      {
        solver.assemble(configuration, stress);
        return solver.solve(fields, candidates, external_forces);
      }

      /// Force and torque that hold the particles, by rigid-body unknown.
      std::vector<double>
      forces() const
      {
        return particle_forces<dim>(
          mesh, bodies, configuration, stress, fields);
      }

      dealii::Point<dim>
      position(const unsigned int node) const
      {
        return node_position<dim>(mesh.positions(), node);
      }

      const MovingMesh<dim>      mesh;
      const RigidBodies<dim>     bodies;
      const NewtonianStress<dim> stress;
      Configuration<dim>         configuration;
      FlowSolver<dim>            solver;
      FlowFields<dim>            fields;

    private:
      static FlowSolverParameters
      controls(const double tolerance, const unsigned int max_iterations)
      {
        FlowSolverParameters parameters;
        parameters.tolerance      = tolerance;
        parameters.max_iterations = max_iterations;
        return parameters;
      }
    };



    /**
     * int sigma : grad(phi e_d) over the fluid for the shape function phi of
     * every node: zero where momentum is balanced node by node, the force on
     * the boundary elsewhere. For one process.
     */
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    nodal_reactions(const StokesProblem<dim> &problem)
    {
      const MovingMesh<dim>               &mesh = problem.mesh;
      CellValues<dim>                      values;
      std::vector<StressCoefficients<dim>> coefficients;
      std::vector<dealii::Tensor<1, dim>>  reactions(mesh.n_global_nodes());
      for (const auto &cell : mesh.cells())
        {
          values.reinit(mesh.cell_positions(cell, mesh.positions()),
                        cell.curved);
          problem.stress.evaluate(cell, values, coefficients);
          for (unsigned int q = 0; q < coefficients.size(); ++q)
            {
              const auto            &point = values.points()[q];
              dealii::Tensor<2, dim> L;
              double                 p = 0.;
              for (unsigned int a = 0; a < mesh.n_nodes; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  L[d] += problem.fields.velocity(dim * cell.nodes[a] + d) *
                          point.quadratic_gradient[a];
              for (unsigned int v = 0; v < mesh.n_vertices; ++v)
                p +=
                  problem.fields.pressure(cell.vertices[v]) * point.linear[v];

              const auto stress = coefficients[q].stress(L) -
                                  p * dealii::unit_symmetric_tensor<dim>();
              for (unsigned int a = 0; a < mesh.n_nodes; ++a)
                reactions[cell.nodes[a]] +=
                  point.JxW * (stress * point.quadratic_gradient[a]);
            }
        }
      return reactions;
    }



    /**
     * A flow that is known: its velocity, the imposed shear included, its
     * pressure, and as a Function the force per volume that drives it.
     */
    template <int dim>
    class ExactFlow : public dealii::Function<dim>
    {
    public:
      ExactFlow()
        : dealii::Function<dim>(dim)
      {}

      virtual dealii::Tensor<1, dim>
      velocity(const dealii::Point<dim> &p) const = 0;

      virtual double
      pressure(const dealii::Point<dim> &p) const = 0;

      virtual dealii::Tensor<1, dim>
      force(const dealii::Point<dim> &p) const = 0;

      double
      value(const dealii::Point<dim> &p,
            const unsigned int        component) const override
      {
        return force(p)[component];
      }
    };



    /// Errors in L2 and the mean size of the cells.
    struct StokesErrors
    {
      double velocity = 0.;
      double pressure = 0.;
      double size     = 0.;
    };



    /**
     * Errors of a solution against an exact flow. Pressures are compared after
     * their means are taken off.
     */
    template <int dim>
    StokesErrors
    stokes_errors(const StokesProblem<dim> &problem,
                  const ExactFlow<dim>     &exact)
    {
      const MovingMesh<dim> &mesh = problem.mesh;
      CellValues<dim>        values(dealii::QWitherdenVincentSimplex<dim>(5));
      double                 velocity_error = 0., volume = 0.;
      double                 pressure_error = 0., pressure_square = 0.;
      for (const auto &cell : mesh.cells())
        {
          if (!cell.owned)
            continue;
          const auto positions = mesh.cell_positions(cell, mesh.positions());
          values.reinit(positions, cell.curved);
          for (const auto &point : values.points())
            {
              dealii::Point<dim>     x;
              dealii::Tensor<1, dim> u;
              double                 p = 0.;
              for (unsigned int a = 0; a < mesh.n_nodes; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    x[d] += point.quadratic[a] * positions[a][d];
                    u[d] += point.quadratic[a] *
                            problem.fields.velocity(dim * cell.nodes[a] + d);
                  }
              for (unsigned int v = 0; v < mesh.n_vertices; ++v)
                p +=
                  point.linear[v] * problem.fields.pressure(cell.vertices[v]);

              const double difference = p - exact.pressure(x);
              velocity_error +=
                point.JxW * (u - exact.velocity(x)).norm_square();
              pressure_error += point.JxW * difference;
              pressure_square += point.JxW * difference * difference;
              volume += point.JxW;
            }
        }
      const auto sum = [&](const double x) {
        return dealii::Utilities::MPI::sum(x, mesh.communicator());
      };
      velocity_error  = sum(velocity_error);
      pressure_error  = sum(pressure_error);
      pressure_square = sum(pressure_square);
      volume          = sum(volume);

      StokesErrors errors;
      errors.velocity = std::sqrt(velocity_error);
      errors.pressure =
        std::sqrt(pressure_square - pressure_error * pressure_error / volume);
      errors.size = std::pow(volume / mesh.n_global_cells(), 1. / dim);
      return errors;
    }



    /// Exponent by which an error falls from one size to another.
    inline double
    order(const double error,
          const double finer_error,
          const double size,
          const double finer_size)
    {
      return std::log(error / finer_error) / std::log(size / finer_size);
    }
  } // namespace Tests
} // namespace Catena

#endif

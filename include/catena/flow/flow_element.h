#ifndef catena_flow_flow_element_h
#define catena_flow_flow_element_h

#include <catena/flow/node_couplings.h>
#include <catena/flow/stress_model.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * The matrices of one cell before constraints, by node and component.
   */
  template <int dim>
  struct FlowElement
  {
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    const typename MovingMesh<dim>::Cell          *cell;
    std::array<const NodeCoupling<dim> *, n_nodes> couplings;
    bool                                           touches_particle;

    /// velocity[i][j][a][b]: component i of node a with component j of node b
    std::array<std::array<std::array<NodeNumbers<dim>, n_nodes>, dim>, dim>
                                                           velocity;
    std::array<NodeVectors<dim>, n_vertices>               divergence;
    NodeVectors<dim>                                       rhs;
    std::array<NodeNumbers<dim>, n_nodes>                  component;
    std::array<std::array<double, n_vertices>, n_vertices> mass;
    std::array<double, n_vertices>                         volume;
    /// int of the shape functions
    NodeNumbers<dim> node_volume;

    void
    reset(const typename MovingMesh<dim>::Cell &new_cell,
          const std::vector<NodeCoupling<dim>> &all_couplings)
    {
      cell             = &new_cell;
      touches_particle = false;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          couplings[a] = &all_couplings[new_cell.nodes[a]];
          touches_particle |= couplings[a]->rigid;
        }
      divergence  = {};
      rhs         = {};
      mass        = {};
      volume      = {};
      node_volume = {};
    }

    /// Integrate everything but a body force.
    void
    integrate(const std::vector<typename CellValues<dim>::PointValues> &points,
              const std::vector<StressCoefficients<dim>> &coefficients,
              const dealii::Tensor<2, dim>               &imposed_gradient)
    {
      add_viscosity(points, coefficients);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          if (coefficients[q].tangent_factor != 0.)
            add_tangent(points[q], coefficients[q]);
          add_known_stress(points[q], coefficients[q].stress(imposed_gradient));
          add_divergence(points[q]);
          add_mass(points[q], dim / dealii::trace(coefficients[q].viscosity));
        }
    }

    /**
     * int (L H + H L^T) : grad v; the trace of int (H L^T) : grad v over the
     * components is int grad u . (H grad v) of a component.
     */
    void
    add_viscosity(
      const std::vector<typename CellValues<dim>::PointValues> &points,
      const std::vector<StressCoefficients<dim>>               &coefficients)
    {
      const unsigned int n_points = points.size();
      fluxes.assign(n_points, {});
      for (unsigned int q = 0; q < n_points; ++q)
        fluxes[q].add_product(points[q].JxW * coefficients[q].viscosity,
                              points[q].quadratic_gradient);

      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          component[a] = {};
          for (unsigned int i = 0; i < dim; ++i)
            {
              for (unsigned int j = 0; j < dim; ++j)
                {
                  NodeNumbers<dim> sums;
                  for (unsigned int q = 0; q < n_points; ++q)
                    sums.add(points[q].quadratic_gradient.components[j][a],
                             fluxes[q].components[i]);
                  velocity[i][j][a] = sums;
                }
              component[a].add(1., velocity[i][i][a]);
            }
          for (unsigned int i = 0; i < dim; ++i)
            velocity[i][i][a].add(1., component[a]);
        }
    }

    void
    add_known_stress(const typename CellValues<dim>::PointValues &point,
                     const dealii::SymmetricTensor<2, dim>       &stress)
    {
      rhs.add_product(-point.JxW * stress, point.quadratic_gradient);
      node_volume.add(point.JxW, point.quadratic);
    }

    void
    add_divergence(const typename CellValues<dim>::PointValues &point)
    {
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const double weight = point.JxW * point.linear[v];
          volume[v] += weight;
          divergence[v].add(-weight, point.quadratic_gradient);
        }
    }

    void
    add_mass(const typename CellValues<dim>::PointValues &point,
             const double                                 fluidity)
    {
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int w = 0; w < n_vertices; ++w)
          mass[v][w] +=
            point.JxW * fluidity * point.linear[v] * point.linear[w];
    }

    /// int k (B:D(u)) (B:D(v)) at one point.
    void
    add_tangent(const typename CellValues<dim>::PointValues &point,
                const StressCoefficients<dim>               &coefficients)
    {
      NodeVectors<dim> tractions;
      tractions.add_product(coefficients.tangent, point.quadratic_gradient);
      const double weight = point.JxW * coefficients.tangent_factor;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int a = 0; a < n_nodes; ++a)
            velocity[i][j][a].add(weight * tractions.components[i][a],
                                  tractions.components[j]);
    }

    void
    add_body_force(const typename CellValues<dim>::PointValues   &point,
                   const typename CellValues<dim>::NodePositions &positions,
                   const dealii::Function<dim>                   &force)
    {
      const dealii::Point<dim> x = position_at<dim>(point, positions);
      for (unsigned int i = 0; i < dim; ++i)
        {
          const double f = point.JxW * force.value(x, i);
          rhs.components[i].add(f, point.quadratic);
        }
    }

    /// Right-hand side without the part of known velocities.
    void
    condense_known_velocities()
    {
      NodeVectors<dim> known;
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int d = 0; d < dim; ++d)
          known.components[d].set(b, couplings[b]->known[d]);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          dealii::Tensor<1, dim> force = rhs[a];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              force[i] -= velocity[i][j][a] * known.components[j];
          rhs.set(a, force);
        }
    }

  private:
    /// by point and component, H grad of the shape functions times the weight
    std::vector<NodeVectors<dim>> fluxes;
  };
} // namespace Catena

#endif

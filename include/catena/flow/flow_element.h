#ifndef catena_flow_flow_element_h
#define catena_flow_flow_element_h

#include <catena/flow/node_couplings.h>
#include <catena/flow/stress_model.h>
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

    using Block = std::array<double, dim * dim>;

    const typename MovingMesh<dim>::Cell          *cell;
    std::array<const NodeCoupling<dim> *, n_nodes> couplings;
    bool                                           touches_particle;

    std::array<std::array<Block, n_nodes>, n_nodes> velocity;
    std::array<std::array<dealii::Tensor<1, dim>, n_nodes>, n_vertices>
                                                           divergence;
    std::array<dealii::Tensor<1, dim>, n_nodes>            rhs;
    std::array<std::array<double, n_nodes>, n_nodes>       component;
    std::array<std::array<double, n_vertices>, n_vertices> mass;
    std::array<double, n_vertices>                         volume;
    /// int of the shape functions
    std::array<double, n_nodes> node_volume;

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
      velocity    = {};
      divergence  = {};
      rhs         = {};
      component   = {};
      mass        = {};
      volume      = {};
      node_volume = {};
    }

    /// K u + B^T p = F, integrated at one point.
    void
    add(const typename CellValues<dim>::PointValues &point,
        const StressCoefficients<dim>               &coefficients,
        const dealii::Tensor<2, dim>                &imposed_gradient)
    {
      std::array<dealii::Tensor<1, dim>, n_nodes> flux;
      for (unsigned int b = 0; b < n_nodes; ++b)
        flux[b] =
          point.JxW * (coefficients.viscosity * point.quadratic_gradient[b]);

      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const dealii::Tensor<1, dim> &gradient = point.quadratic_gradient[a];
          for (unsigned int b = 0; b < n_nodes; ++b)
            {
              Block       &block    = velocity[a][b];
              const double diagonal = gradient * flux[b];
              component[a][b] += diagonal;
              for (unsigned int i = 0; i < dim; ++i)
                {
                  for (unsigned int j = 0; j < dim; ++j)
                    block[dim * i + j] += gradient[j] * flux[b][i];
                  block[(dim + 1) * i] += diagonal;
                }
            }
        }

      if (coefficients.tangent_factor != 0.)
        add_tangent(point, coefficients);

      const dealii::SymmetricTensor<2, dim> imposed_stress =
        coefficients.stress(imposed_gradient);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          rhs[a] -= point.JxW * (imposed_stress * point.quadratic_gradient[a]);
          node_volume[a] += point.JxW * point.quadratic[a];
        }

      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int b = 0; b < n_nodes; ++b)
          divergence[v][b] -=
            point.JxW * point.linear[v] * point.quadratic_gradient[b];

      const double fluidity = dim / dealii::trace(coefficients.viscosity);
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          volume[v] += point.JxW * point.linear[v];
          for (unsigned int w = 0; w < n_vertices; ++w)
            mass[v][w] +=
              point.JxW * fluidity * point.linear[v] * point.linear[w];
        }
    }

    /// int k (B:D(u)) (B:D(v)) at one point.
    void
    add_tangent(const typename CellValues<dim>::PointValues &point,
                const StressCoefficients<dim>               &coefficients)
    {
      const double weight = point.JxW * coefficients.tangent_factor;
      std::array<dealii::Tensor<1, dim>, n_nodes> traction;
      for (unsigned int a = 0; a < n_nodes; ++a)
        traction[a] = coefficients.tangent * point.quadratic_gradient[a];
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              velocity[a][b][dim * i + j] +=
                weight * traction[a][i] * traction[b][j];
    }

    void
    add_body_force(const typename CellValues<dim>::PointValues   &point,
                   const typename CellValues<dim>::NodePositions &positions,
                   const dealii::Function<dim>                   &force)
    {
      dealii::Point<dim> x;
      for (unsigned int a = 0; a < n_nodes; ++a)
        x += point.quadratic[a] * dealii::Tensor<1, dim>(positions[a]);
      for (unsigned int i = 0; i < dim; ++i)
        {
          const double f = point.JxW * force.value(x, i);
          for (unsigned int a = 0; a < n_nodes; ++a)
            rhs[a][i] += f * point.quadratic[a];
        }
    }

    /// Right-hand side without the part of known velocities.
    void
    condense_known_velocities()
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              rhs[a][i] -= velocity[a][b][dim * i + j] * couplings[b]->known[j];
    }
  };
} // namespace Catena

#endif

#ifndef catena_flow_flow_element_h
#define catena_flow_flow_element_h

#include <catena/flow/stress_model.h>
#include <catena/mesh/cell_values.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * What FlowSystem is given of a cell: forces at its nodes and volumes.
   */
  template <int dim>
  struct FlowElement
  {
    /// -int S : grad v, with S the stress of the imposed flow
    NodeVectors<dim> forces = {};
    /// int v and int q of the shape functions
    NodeNumbers<dim>                        node_volume = {};
    std::array<double, n_linear_nodes(dim)> volume      = {};

    FlowElement(
      const std::vector<typename CellValues<dim>::PointValues> &points,
      const std::vector<StressCoefficients<dim>>               &coefficients,
      const dealii::Tensor<2, dim> &imposed_gradient)
    {
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto &point = points[q];
          forces.add_product(-point.JxW *
                               coefficients[q].stress(imposed_gradient),
                             point.quadratic_gradient);
          node_volume.add(point.JxW, point.quadratic);
          for (unsigned int v = 0; v < volume.size(); ++v)
            volume[v] += point.JxW * point.linear[v];
        }
    }
  };



  /**
   * The matrices of a cell that the preconditioner is made of, by node and
   * vertex, with the tensor viscosity H.
   */
  template <int dim>
  struct PreconditionerElement
  {
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    /// int grad v . (H grad u) of one component
    std::array<NodeNumbers<dim>, n_nodes> component = {};
    /// -int p div v, by vertex
    std::array<NodeVectors<dim>, n_vertices> gradient = {};
    /// int p q / viscosity
    std::array<std::array<double, n_vertices>, n_vertices> mass = {};

    PreconditionerElement(
      const std::vector<typename CellValues<dim>::PointValues> &points,
      const std::vector<StressCoefficients<dim>>               &coefficients)
    {
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto      &point = points[q];
          NodeVectors<dim> flux;
          flux.add_product(point.JxW * coefficients[q].viscosity,
                           point.quadratic_gradient);
          for (unsigned int a = 0; a < n_nodes; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              component[a].add(point.quadratic_gradient.components[d][a],
                               flux.components[d]);

          const double fluidity =
            dim / dealii::trace(coefficients[q].viscosity);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              const double weight = point.JxW * point.linear[v];
              gradient[v].add(-weight, point.quadratic_gradient);
              for (unsigned int w = 0; w < n_vertices; ++w)
                mass[v][w] += weight * fluidity * point.linear[w];
            }
        }
    }
  };
} // namespace Catena

#endif

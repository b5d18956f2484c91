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

#include <experimental/simd>

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

    /// A number for each node, in whole registers of the processor.
    using Register = std::experimental::native_simd<double>;
    static constexpr unsigned int width       = Register::size();
    static constexpr unsigned int n_registers = (n_nodes + width - 1) / width;
    struct NodeNumbers
    {
      std::array<Register, n_registers> registers = {};

      double
      operator[](const unsigned int a) const
      {
        return registers[a / width][a % width];
      }

      void
      set(const unsigned int a, const double value)
      {
        registers[a / width][a % width] = value;
      }

      /// this += factor x
      void
      add(const double factor, const NodeNumbers &x)
      {
        for (unsigned int r = 0; r < n_registers; ++r)
          registers[r] += factor * x.registers[r];
      }
    };

    const typename MovingMesh<dim>::Cell          *cell;
    std::array<const NodeCoupling<dim> *, n_nodes> couplings;
    bool                                           touches_particle;

    /// velocity[i][j][a][b]: component i of node a with component j of node b
    std::array<std::array<std::array<NodeNumbers, n_nodes>, dim>, dim> velocity;
    std::array<std::array<dealii::Tensor<1, dim>, n_nodes>, n_vertices>
                                                           divergence;
    std::array<dealii::Tensor<1, dim>, n_nodes>            rhs;
    std::array<NodeNumbers, n_nodes>                       component;
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
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            const dealii::Tensor<1, dim> flux =
              points[q].JxW *
              (coefficients[q].viscosity * points[q].quadratic_gradient[b]);
            for (unsigned int i = 0; i < dim; ++i)
              fluxes[q][i].set(b, flux[i]);
          }

      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          component[a] = {};
          for (unsigned int i = 0; i < dim; ++i)
            {
              for (unsigned int j = 0; j < dim; ++j)
                {
                  NodeNumbers sums;
                  for (unsigned int q = 0; q < n_points; ++q)
                    sums.add(points[q].quadratic_gradient[a][j], fluxes[q][i]);
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
      const dealii::SymmetricTensor<2, dim> weighted = point.JxW * stress;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          rhs[a] -= weighted * point.quadratic_gradient[a];
          node_volume[a] += point.JxW * point.quadratic[a];
        }
    }

    void
    add_divergence(const typename CellValues<dim>::PointValues &point)
    {
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const double weight = point.JxW * point.linear[v];
          volume[v] += weight;
          for (unsigned int b = 0; b < n_nodes; ++b)
            divergence[v][b] -= weight * point.quadratic_gradient[b];
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
      std::array<NodeNumbers, dim> tractions;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const dealii::Tensor<1, dim> traction =
            coefficients.tangent * point.quadratic_gradient[a];
          for (unsigned int i = 0; i < dim; ++i)
            tractions[i].set(a, traction[i]);
        }
      const double weight = point.JxW * coefficients.tangent_factor;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int a = 0; a < n_nodes; ++a)
            velocity[i][j][a].add(weight * tractions[i][a], tractions[j]);
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
              rhs[a][i] -= velocity[i][j][a][b] * couplings[b]->known[j];
    }

  private:
    /// by point and component, H grad of the shape functions times the weight
    std::vector<std::array<NodeNumbers, dim>> fluxes;
  };
} // namespace Catena

#endif

#ifndef catena_flow_cell_kernels_h
#define catena_flow_cell_kernels_h

#include <catena/base/types.h>
#include <catena/flow/flow_cells.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/quadratic_shape.h>

#include <deal.II/base/quadrature.h>

#include <algorithm>
#include <array>
#include <vector>

#include <experimental/simd>

namespace Catena
{
  /**
   * What FlowCells computes for some cells at once.
   */
  namespace CellKernels
  {
    /// Gradients of the P2 and values of the P1 shape functions at one point of
    /// the reference cell.
    template <int dim, typename Number>
    struct ReferencePoint
    {
      std::array<std::array<Number, dim>, n_quadratic_nodes(dim)> gradients;
      std::array<Number, n_linear_nodes(dim)>                     linear;
    };

    template <int dim, typename Number>
    using ReferenceRule = std::vector<ReferencePoint<dim, Number>>;

    template <int dim, typename Number>
    ReferenceRule<dim, Number>
    tabulate(const dealii::Quadrature<dim> &quadrature)
    {
      ReferenceRule<dim, Number> points;
      for (const dealii::Point<dim> &x : quadrature.get_points())
        {
          ReferencePoint<dim, Number> point;
          const auto gradients = quadratic_shape_gradients<dim>(x);
          const auto lambda    = barycentric_coordinates<dim>(x);
          for (unsigned int a = 0; a < point.gradients.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              point.gradients[a][d] = gradients[a][d];
          std::copy(lambda.begin(), lambda.end(), point.linear.begin());
          points.push_back(point);
        }
      return points;
    }

    template <int dim, typename Number>
    const ReferenceRule<dim, Number> &
    reference_rule(const bool curved)
    {
      static const auto straight_rule =
                          tabulate<dim, Number>(CellValues<dim>::rule(false)),
                        curved_rule =
                          tabulate<dim, Number>(CellValues<dim>::rule(true));
      return curved ? curved_rule : straight_rule;
    }



    /**
     * One number of each cell of a batch.
     */
    template <int dim, typename Number>
    using CellPack = std::experimental::simd<
      Number,
      std::experimental::simd_abi::deduce_t<Number, int(cells_at_once)>>;

    template <int dim, typename Number>
    CellPack<dim, Number>
    load(const Number *&numbers)
    {
      const CellPack<dim, Number> pack(numbers,
                                       std::experimental::element_aligned);
      numbers += cells_at_once;
      return pack;
    }



    /// A symmetric tensor of each cell.
    template <int dim, typename Number>
    struct SymmetricPacks
    {
      using Pack = CellPack<dim, Number>;
      std::array<std::array<Pack, dim>, dim> components;

      explicit SymmetricPacks(const Number *&numbers)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            components[i][j] = components[j][i] = load<dim>(numbers);
      }

      const std::array<Pack, dim> &
      operator[](const unsigned int i) const
      {
        return components[i];
      }
    };



    /// By node, what the cells of a batch are given or add.
    template <int dim, typename Number>
    struct NodePacks
    {
      static constexpr unsigned int n_nodes = n_quadratic_nodes(dim),
                                    width   = cells_at_once;
      using Pack                            = CellPack<dim, Number>;
      using AtNode                          = std::experimental::simd<
        Number,
        std::experimental::simd_abi::deduce_t<Number, int(n_node_numbers)>>;

      std::array<std::array<Pack, n_node_numbers>, n_nodes> values;

      void
      gather(const unsigned int *nodes, const Number *src)
      {
        alignas(std::experimental::memory_alignment_v<Pack>)
          Number buffer[n_node_numbers][width];
        for (unsigned int a = 0; a < n_nodes; ++a, nodes += width)
          {
            for (unsigned int cell = 0; cell < width; ++cell)
              for (unsigned int c = 0; c < n_node_numbers; ++c)
                buffer[c][cell] = src[n_node_numbers * nodes[cell] + c];
            for (unsigned int c = 0; c < n_node_numbers; ++c)
              values[a][c] = Pack(buffer[c], std::experimental::vector_aligned);
          }
      }

      void
      scatter(const unsigned int *nodes, Number *dst) const
      {
        alignas(std::experimental::memory_alignment_v<Pack>)
          Number buffer[n_node_numbers][width];
        for (unsigned int a = 0; a < n_nodes; ++a, nodes += width)
          {
            for (unsigned int c = 0; c < n_node_numbers; ++c)
              values[a][c].copy_to(buffer[c],
                                   std::experimental::vector_aligned);
            for (unsigned int cell = 0; cell < width; ++cell)
              {
                Number *const node = dst + n_node_numbers * nodes[cell];
                AtNode        sums(node, std::experimental::element_aligned);
                sums += AtNode([&](const auto c) { return buffer[c][cell]; });
                sums.copy_to(node, std::experimental::element_aligned);
              }
          }
      }
    };



    /// A tensor of each cell.
    template <int dim, typename Number>
    using TensorPacks = std::array<std::array<CellPack<dim, Number>, dim>, dim>;



    /// Gradient of the velocity.
    /// @param J rows: gradients of the coordinates of the reference cell
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    velocity_gradient(const ReferencePoint<dim, Number> &point,
                      const TensorPacks<dim, Number>    &J,
                      const NodePacks<dim, Number>      &x)
    {
      TensorPacks<dim, Number> L = {};
      for (unsigned int i = 0; i < dim; ++i)
        {
          std::array<CellPack<dim, Number>, dim> slope = {};
          for (unsigned int a = 0; a < n_quadratic_nodes(dim); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              slope[d] += point.gradients[a][d] * x.values[a][i];
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int d = 0; d < dim; ++d)
              L[i][j] += slope[d] * J[d][j];
        }
      return L;
    }



    /// L H + H L^T or, with the roles of u and v exchanged, (L + L^T) H.
    template <int dim, typename Number, bool transposed>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    viscous_stress(const TensorPacks<dim, Number>    &L,
                   const SymmetricPacks<dim, Number> &H)
    {
      TensorPacks<dim, Number> product = {}, stress;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            product[i][j] +=
              (transposed ? L[i][k] + L[k][i] : L[i][k]) * H[k][j];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          stress[i][j] =
            transposed ? product[i][j] : product[i][j] + product[j][i];
      return stress;
    }



    /// Add factor (B:L) B.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE void
    add_tangent(TensorPacks<dim, Number>          &stress,
                const TensorPacks<dim, Number>    &L,
                const CellPack<dim, Number>       &factor,
                const SymmetricPacks<dim, Number> &B)
    {
      CellPack<dim, Number> rate(0);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          rate += B[i][j] * L[i][j];
      rate *= factor;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          stress[i][j] += rate * B[i][j];
    }



    /// Add stress : grad v.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE void
    add_forces(NodePacks<dim, Number>            &y,
               const TensorPacks<dim, Number>    &stress,
               const ReferencePoint<dim, Number> &point,
               const TensorPacks<dim, Number>    &J)
    {
      for (unsigned int i = 0; i < dim; ++i)
        {
          std::array<CellPack<dim, Number>, dim> flux = {};
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int j = 0; j < dim; ++j)
              flux[d] += stress[i][j] * J[d][j];
          for (unsigned int a = 0; a < n_quadratic_nodes(dim); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              y.values[a][i] += point.gradients[a][d] * flux[d];
        }
    }



    /**
     * The sums of the cells of a batch, point by point.
     */
    template <int dim, typename Number, bool curved, bool transposed>
    void
    integrate(const ReferenceRule<dim, Number> &rule,
              const bool                        with_tangents,
              const Number                     *numbers,
              const NodePacks<dim, Number>     &x,
              NodePacks<dim, Number>           &y)
    {
      using Pack = CellPack<dim, Number>;
      for (auto &node : y.values)
        node.fill(Pack(0));

      TensorPacks<dim, Number> J             = {};
      const auto               load_jacobian = [&]() {
        for (auto &row : J)
          for (Pack &entry : row)
            entry = load<dim>(numbers);
      };
      if (!curved)
        load_jacobian();
      for (const auto &point : rule)
        {
          if (curved)
            load_jacobian();
          const Pack                        JxW = load<dim>(numbers);
          const SymmetricPacks<dim, Number> H(numbers);
          const auto L      = velocity_gradient<dim, Number>(point, J, x);
          auto       stress = viscous_stress<dim, Number, transposed>(L, H);
          if (with_tangents)
            {
              const Pack                        factor = load<dim>(numbers);
              const SymmetricPacks<dim, Number> B(numbers);
              add_tangent<dim, Number>(stress, L, factor, B);
            }

          Pack pressure(0), divergence(0);
          for (unsigned int v = 0; v < n_linear_nodes(dim); ++v)
            pressure += point.linear[v] * x.values[v][dim];
          for (unsigned int i = 0; i < dim; ++i)
            {
              stress[i][i] -= JxW * pressure;
              divergence += JxW * L[i][i];
            }
          for (unsigned int v = 0; v < n_linear_nodes(dim); ++v)
            y.values[v][dim] -= point.linear[v] * divergence;
          add_forces<dim, Number>(y, stress, point, J);
        }
    }
  } // namespace CellKernels
} // namespace Catena

#endif

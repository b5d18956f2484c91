#ifndef catena_flow_cell_kernels_h
#define catena_flow_cell_kernels_h

#include <catena/base/types.h>
#include <catena/flow/cell_tensors.h>
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
    /// The points of a quadrature rule by their barycentric coordinates.
    template <int dim, typename Number>
    using ReferenceRule = std::vector<std::array<Number, n_linear_nodes(dim)>>;

    template <int dim, typename Number>
    ReferenceRule<dim, Number>
    tabulate(const dealii::Quadrature<dim> &quadrature)
    {
      ReferenceRule<dim, Number> points;
      for (const dealii::Point<dim> &x : quadrature.get_points())
        {
          const auto lambda = barycentric_coordinates<dim>(x);
          points.emplace_back();
          std::copy(lambda.begin(), lambda.end(), points.back().begin());
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



    /// The numbers of a node, wherever they are.
    template <typename Number>
    using AtNode __attribute__((vector_size(n_node_numbers * sizeof(Number)),
                                aligned(sizeof(Number)),
                                may_alias)) = Number;

    /// Of n_node_numbers nodes: from node by node to number by number, or back.
    template <typename Number>
    inline DEAL_II_ALWAYS_INLINE void
    transpose(AtNode<Number> (&v)[n_node_numbers])
    {
      static_assert(n_node_numbers == 4);
      const AtNode<Number> low_01 =
                             __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5),
                           high_01 =
                             __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7),
                           low_23 =
                             __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5),
                           high_23 =
                             __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);
      v[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
      v[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
      v[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
      v[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
    }



    /// By node, what the cells of a batch are given or add.
    template <int dim, typename Number>
    class NodePacks
    {
    public:
      using Pack = CellPack<dim, Number>;

      Pack
      get(const unsigned int node, const unsigned int number) const
      {
        return Pack(numbers[node][number], std::experimental::vector_aligned);
      }

      void
      set(const unsigned int node, const unsigned int number, const Pack &pack)
      {
        pack.copy_to(numbers[node][number], std::experimental::vector_aligned);
      }

      void
      gather(const unsigned int *nodes, const Number *src)
      {
        for (auto &packs : numbers)
          for (unsigned int cell = 0; cell < cells_at_once; cell += n)
            {
              AtNode<Number> block[n];
              for (unsigned int k = 0; k < n; ++k)
                block[k] = at(src + n * *nodes++);
              transpose<Number>(block);
              for (unsigned int k = 0; k < n; ++k)
                at(packs[k] + cell) = block[k];
            }
      }

      void
      scatter(const unsigned int *nodes, Number *dst) const
      {
        for (const auto &packs : numbers)
          for (unsigned int cell = 0; cell < cells_at_once; cell += n)
            {
              AtNode<Number> block[n];
              for (unsigned int k = 0; k < n; ++k)
                block[k] = at(packs[k] + cell);
              transpose<Number>(block);
              for (unsigned int k = 0; k < n; ++k)
                at(dst + n * *nodes++) += block[k];
            }
      }

    private:
      static constexpr unsigned int n = n_node_numbers;
      static_assert(cells_at_once % n == 0);

      alignas(std::experimental::memory_alignment_v<Pack>)
        Number numbers[n_quadratic_nodes(dim)][n][cells_at_once];

      static AtNode<Number> &
      at(Number *first)
      {
        return *reinterpret_cast<AtNode<Number> *>(first);
      }

      static const AtNode<Number> &
      at(const Number *first)
      {
        return *reinterpret_cast<const AtNode<Number> *>(first);
      }
    };



    /// By vertex, component and coordinate of the reference cell: derivatives
    /// of P2 functions, which are linear between the vertices.
    template <int dim, typename Number>
    using VertexGradients =
      std::array<TensorPacks<dim, Number>, n_linear_nodes(dim)>;



    /// The nodes at the vertices, and on the edges between two of them.
    template <int dim>
    constexpr std::array<std::array<unsigned int, dim + 1>, dim + 1>
    nodes_between_vertices()
    {
      std::array<std::array<unsigned int, dim + 1>, dim + 1> nodes = {};
      for (unsigned int v = 0; v <= dim; ++v)
        nodes[v][v] = v;
      for (unsigned int node = dim + 1; node < n_quadratic_nodes(dim); ++node)
        {
          const auto ends         = simplex_edge(node - dim - 1);
          nodes[ends[0]][ends[1]] = nodes[ends[1]][ends[0]] = node;
        }
      return nodes;
    }



    /// Gradients of the velocity: in barycentric coordinates L the derivative
    /// by L_k at the vertex v is 4 u_kv - u_k, with u_vv = u_v.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE VertexGradients<dim, Number>
    vertex_gradients(const NodePacks<dim, Number> &x)
    {
      constexpr auto               between = nodes_between_vertices<dim>();
      VertexGradients<dim, Number> gradients;
      for (unsigned int v = 0; v <= dim; ++v)
        for (unsigned int i = 0; i < dim; ++i)
          {
            std::array<CellPack<dim, Number>, dim + 1> slopes;
            for (unsigned int k = 0; k <= dim; ++k)
              slopes[k] = Number(4) * x.get(between[k][v], i) - x.get(k, i);
            for (unsigned int d = 0; d < dim; ++d)
              gradients[v][i][d] = slopes[d + 1] - slopes[0];
          }
      return gradients;
    }



    /// The transpose of vertex_gradients(): the forces at the nodes.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE void
    set_forces(NodePacks<dim, Number>             &y,
               const VertexGradients<dim, Number> &fluxes)
    {
      constexpr auto between = nodes_between_vertices<dim>();
      using Pack             = CellPack<dim, Number>;
      for (unsigned int i = 0; i < dim; ++i)
        {
          std::array<Pack, n_quadratic_nodes(dim)> forces = {};
          for (unsigned int v = 0; v <= dim; ++v)
            for (unsigned int k = 0; k <= dim; ++k)
              {
                Pack slope(0);
                if (k > 0)
                  slope = fluxes[v][i][k - 1];
                else
                  for (unsigned int d = 0; d < dim; ++d)
                    slope -= fluxes[v][i][d];
                forces[between[k][v]] += Number(4) * slope;
                forces[k] -= slope;
              }
          for (unsigned int node = 0; node < forces.size(); ++node)
            y.set(node, i, forces[node]);
        }
    }



    /// The tensor at a point, of those at the vertices.
    template <int dim, typename Number, bool symmetric>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    interpolate(const std::array<Number, n_linear_nodes(dim)> &lambda,
                const VertexGradients<dim, Number>            &tensors)
    {
      TensorPacks<dim, Number> result = {};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < (symmetric ? i + 1 : dim); ++j)
          {
            for (unsigned int v = 0; v <= dim; ++v)
              result[i][j] += lambda[v] * tensors[v][i][j];
            if (symmetric)
              result[j][i] = result[i][j];
          }
      return result;
    }



    /// The transpose of interpolate(): of symmetric tensors the lower half is
    /// added.
    template <int dim, typename Number, bool symmetric>
    inline DEAL_II_ALWAYS_INLINE void
    add_at_vertices(VertexGradients<dim, Number>                  &tensors,
                    const std::array<Number, n_linear_nodes(dim)> &lambda,
                    const TensorPacks<dim, Number>                &tensor)
    {
      for (unsigned int v = 0; v <= dim; ++v)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < (symmetric ? i + 1 : dim); ++j)
            tensors[v][i][j] += lambda[v] * tensor[i][j];
    }



    /**
     * The sums of the cells of a batch, point by point. The map of a cell
     * without curved faces is the same at all points: all is done in real
     * coordinates then. Of tensors that are symmetric there, the stresses but
     * for transposed ones, and the rates of strain of a fluid with a scalar
     * viscosity, only one half is computed.
     */
    template <int dim,
              typename Number,
              bool curved,
              bool scalar_viscosity,
              bool transposed>
    void
    integrate(const ReferenceRule<dim, Number> &rule,
              const bool                        with_tangents,
              CellNumbers<dim, Number>          numbers,
              const NodePacks<dim, Number>     &x,
              NodePacks<dim, Number>           &y)
    {
      using Pack                      = CellPack<dim, Number>;
      using Tensors                   = TensorPacks<dim, Number>;
      constexpr bool symmetric_rates  = !curved && scalar_viscosity,
                     symmetric_fluxes = !curved && !transposed;

      Tensors    J             = {};
      const auto load_jacobian = [&]() {
        for (auto &row : J)
          for (Pack &entry : row)
            entry = numbers.next();
      };
      auto gradients = vertex_gradients<dim, Number>(x);
      if (!curved)
        {
          load_jacobian();
          for (Tensors &gradient : gradients)
            {
              gradient = to_real<dim, Number>(gradient, J);
              if (scalar_viscosity)
                gradient = symmetric_part<dim, Number>(gradient);
            }
        }
      VertexGradients<dim, Number>          fluxes      = {};
      std::array<Pack, n_linear_nodes(dim)> divergences = {};
      for (const auto &lambda : rule)
        {
          Tensors L =
            interpolate<dim, Number, symmetric_rates>(lambda, gradients);
          if (curved)
            {
              load_jacobian();
              L = to_real<dim, Number>(L, J);
              if (scalar_viscosity)
                L = symmetric_part<dim, Number>(L);
            }
          const Pack JxW = numbers.next();
          Tensors    stress;
          if constexpr (scalar_viscosity)
            stress = multiple<dim, Number>(L, Number(2) * numbers.next());
          else
            stress = viscous_stress<dim, Number, transposed>(
              L, SymmetricPacks<dim, Number>(numbers));
          if (with_tangents)
            {
              const Pack                        factor = numbers.next();
              const SymmetricPacks<dim, Number> B(numbers);
              add_tangent<dim, Number>(stress, L, factor, B);
            }

          Pack pressure(0), divergence(0);
          for (unsigned int v = 0; v < n_linear_nodes(dim); ++v)
            pressure += lambda[v] * x.get(v, dim);
          for (unsigned int i = 0; i < dim; ++i)
            {
              stress[i][i] -= JxW * pressure;
              divergence += JxW * L[i][i];
            }
          for (unsigned int v = 0; v < n_linear_nodes(dim); ++v)
            divergences[v] += lambda[v] * divergence;
          add_at_vertices<dim, Number, symmetric_fluxes>(
            fluxes,
            lambda,
            curved ? to_reference<dim, Number>(stress, J) : stress);
        }

      if (!curved)
        for (Tensors &flux : fluxes)
          {
            if (symmetric_fluxes)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < i; ++j)
                  flux[j][i] = flux[i][j];
            flux = to_reference<dim, Number>(flux, J);
          }
      set_forces<dim, Number>(y, fluxes);
      for (unsigned int node = 0; node < n_quadratic_nodes(dim); ++node)
        for (unsigned int number = dim; number < n_node_numbers; ++number)
          y.set(node,
                number,
                number == dim && node < n_linear_nodes(dim) ?
                  -divergences[node] :
                  Pack(0));
    }
  } // namespace CellKernels
} // namespace Catena

#endif

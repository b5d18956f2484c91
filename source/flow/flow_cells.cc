#include <catena/flow/flow_cells.h>
#include <catena/mesh/quadratic_shape.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

#include <experimental/simd>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    namespace simd = std::experimental;

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
    tabulate(const Quadrature<dim> &quadrature)
    {
      ReferenceRule<dim, Number> points;
      for (const Point<dim> &x : quadrature.get_points())
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
    using CellPack = simd::simd<
      Number,
      simd::simd_abi::deduce_t<Number, int(CellBatches<dim>::width)>>;

    template <int dim, typename Number>
    CellPack<dim, Number>
    load(const Number *&numbers)
    {
      const CellPack<dim, Number> pack(numbers, simd::element_aligned);
      numbers += CellBatches<dim>::width;
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
                                    width   = CellBatches<dim>::width;
      using Pack                            = CellPack<dim, Number>;
      using AtNode =
        simd::simd<Number,
                   simd::simd_abi::deduce_t<Number, int(n_node_numbers)>>;

      std::array<std::array<Pack, n_node_numbers>, n_nodes> values;

      void
      gather(const unsigned int *nodes, const Number *src)
      {
        alignas(simd::memory_alignment_v<Pack>)
          Number buffer[n_node_numbers][width];
        for (unsigned int a = 0; a < n_nodes; ++a, nodes += width)
          {
            for (unsigned int cell = 0; cell < width; ++cell)
              for (unsigned int c = 0; c < n_node_numbers; ++c)
                buffer[c][cell] = src[n_node_numbers * nodes[cell] + c];
            for (unsigned int c = 0; c < n_node_numbers; ++c)
              values[a][c] = Pack(buffer[c], simd::vector_aligned);
          }
      }

      void
      scatter(const unsigned int *nodes, Number *dst) const
      {
        alignas(simd::memory_alignment_v<Pack>)
          Number buffer[n_node_numbers][width];
        for (unsigned int a = 0; a < n_nodes; ++a, nodes += width)
          {
            for (unsigned int c = 0; c < n_node_numbers; ++c)
              values[a][c].copy_to(buffer[c], simd::vector_aligned);
            for (unsigned int cell = 0; cell < width; ++cell)
              {
                Number *const node = dst + n_node_numbers * nodes[cell];
                AtNode        sums(node, simd::element_aligned);
                sums += AtNode([&](const auto c) { return buffer[c][cell]; });
                sums.copy_to(node, simd::element_aligned);
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
  } // namespace



  template <int dim, typename Number>
  FlowCells<dim, Number>::FlowCells(const MovingMesh<dim> &mesh,
                                    const Partitioner     &nodes)
  {
    constexpr unsigned int width  = CellBatches<dim>::width;
    auto                   placed = std::make_shared<std::vector<Place>>();
    placed->resize(mesh.cells().size());
    for (const bool curved : {false, true})
      {
        const auto batches = std::make_shared<CellBatches<dim>>();
        batches->curved    = curved;
        for (unsigned int c = 0; c < mesh.cells().size(); ++c)
          if (mesh.cells()[c].owned && mesh.cells()[c].curved == curved)
            {
              (*placed)[c] = {static_cast<unsigned int>(groups.size()),
                              static_cast<unsigned int>(batches->cells.size())};
              batches->cells.push_back(c);
            }
        if (batches->cells.empty())
          continue;
        for (unsigned int first = 0; first < batches->cells.size();
             first += width)
          for (unsigned int a = 0; a < n_quadratic_nodes(dim); ++a)
            for (unsigned int i = first; i < first + width; ++i)
              batches->nodes.push_back(nodes.global_to_local(
                mesh
                  .cells()[batches->cells[std::min<unsigned int>(
                    i, batches->cells.size() - 1)]]
                  .nodes[a]));
        groups.push_back({batches, {}});
      }
    places = placed;
    resize();
  }



  /// Those of each cell of a group.
  template <int dim, typename Number>
  unsigned int
  FlowCells<dim, Number>::n_numbers(const Group &group) const
  {
    const bool         curved   = group.batches->curved;
    const unsigned int n_points = reference_rule<dim, Number>(curved).size();
    return (curved ? n_points : 1) * dim * dim +
           n_points * (with_tangents ? 2 : 1) *
             (1 + n_symmetric_components(dim));
  }



  template <int dim, typename Number>
  void
  FlowCells<dim, Number>::resize()
  {
    for (Group &group : groups)
      group.numbers.assign(std::size_t(group.batches->n_batches()) *
                             CellBatches<dim>::width * n_numbers(group),
                           Number());
  }



  template <int dim, typename Number>
  void
  FlowCells<dim, Number>::use_tangents(const bool there_are)
  {
    if (with_tangents == there_are)
      return;
    with_tangents = there_are;
    resize();
  }



  template <int dim, typename Number>
  void
  FlowCells<dim, Number>::set(
    const unsigned int                                        cell,
    const std::vector<typename CellValues<dim>::PointValues> &points,
    const std::vector<StressCoefficients<dim>>               &coefficients)
  {
    constexpr unsigned int width = CellBatches<dim>::width;
    const Place            place = (*places)[cell];
    Group                 &group = groups[place.group];

    Number *next = group.numbers.data() +
                   std::size_t(place.index / width) * width * n_numbers(group) +
                   place.index % width;
    const auto add = [&](const double number) {
      *next = number;
      next += width;
    };
    const auto add_symmetric = [&](const double                   factor,
                                   const SymmetricTensor<2, dim> &tensor) {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          add(factor * tensor[i][j]);
    };
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        if (group.batches->curved || q == 0)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int j = 0; j < dim; ++j)
              add(points[q].linear_gradient[d + 1][j]);
        add(points[q].JxW);
        add_symmetric(points[q].JxW, coefficients[q].viscosity);
        if (with_tangents)
          {
            add(points[q].JxW * coefficients[q].tangent_factor);
            add_symmetric(1., coefficients[q].tangent);
          }
      }
  }



  template <int dim, typename Number>
  template <typename OtherNumber>
  void
  FlowCells<dim, Number>::copy(const FlowCells<dim, OtherNumber> &other)
  {
    groups.resize(other.groups.size());
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        groups[g].batches = other.groups[g].batches;
        groups[g].numbers.assign(other.groups[g].numbers.begin(),
                                 other.groups[g].numbers.end());
      }
    with_tangents = other.with_tangents;
  }



  template <int dim, typename Number>
  template <bool transposed>
  void
  FlowCells<dim, Number>::add(Number *dst, const Number *src) const
  {
    constexpr unsigned int width = CellBatches<dim>::width;
    NodePacks<dim, Number> x, y;
    for (const Group &group : groups)
      {
        const auto &rule = reference_rule<dim, Number>(group.batches->curved);
        const unsigned int *nodes   = group.batches->nodes.data();
        const Number       *numbers = group.numbers.data();
        const unsigned int  n       = group.batches->n_batches();
        for (unsigned int batch = 0; batch < n; ++batch)
          {
            x.gather(nodes, src);
            if (group.batches->curved)
              integrate<dim, Number, true, transposed>(
                rule, with_tangents, numbers, x, y);
            else
              integrate<dim, Number, false, transposed>(
                rule, with_tangents, numbers, x, y);
            y.scatter(nodes, dst);
            nodes += n_quadratic_nodes(dim) * width;
            numbers += width * n_numbers(group);
          }
      }
  }



  template <int dim, typename Number>
  void
  FlowCells<dim, Number>::add_product(Number *dst, const Number *src) const
  {
    add<false>(dst, src);
  }



  template <int dim, typename Number>
  void
  FlowCells<dim, Number>::add_transposed_product(Number       *dst,
                                                 const Number *src) const
  {
    add<true>(dst, src);
  }



  template <int dim, typename Number>
  std::size_t
  FlowCells<dim, Number>::memory_consumption() const
  {
    std::size_t bytes = 0;
    for (const Group &group : groups)
      bytes += group.numbers.size() * sizeof(Number) +
               group.batches->nodes.size() * sizeof(unsigned int);
    return bytes;
  }



  template class FlowCells<2, double>;
  template class FlowCells<3, double>;
  template class FlowCells<2, float>;
  template class FlowCells<3, float>;
  template void
  FlowCells<2, float>::copy(const FlowCells<2, double> &);
  template void
  FlowCells<3, float>::copy(const FlowCells<3, double> &);
} // namespace Catena

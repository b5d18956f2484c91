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

    /// The shape functions at the points of a rule.
    template <int dim, typename Number>
    struct ReferenceRule
    {
      static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
      static constexpr unsigned int n_vertices = n_linear_nodes(dim);

      struct ReferencePoint
      {
        std::array<std::array<Number, dim>, n_nodes> gradients;
        std::array<Number, n_vertices>               linear;
      };
      std::vector<ReferencePoint> points;

      explicit ReferenceRule(const Quadrature<dim> &quadrature)
      {
        for (const Point<dim> &x : quadrature.get_points())
          {
            ReferencePoint point;
            const auto     gradients = quadratic_shape_gradients<dim>(x);
            const auto     lambda    = barycentric_coordinates<dim>(x);
            for (unsigned int a = 0; a < n_nodes; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                point.gradients[a][d] = gradients[a][d];
            std::copy(lambda.begin(), lambda.end(), point.linear.begin());
            points.push_back(point);
          }
      }
    };

    template <int dim, typename Number>
    const ReferenceRule<dim, Number> &
    reference_rule(const bool curved)
    {
      static const ReferenceRule<dim, Number> straight_rule(
        CellValues<dim>::rule(false)),
        curved_rule(CellValues<dim>::rule(true));
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
        alignas(64) Number buffer[n_node_numbers][width];
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
        alignas(64) Number buffer[n_node_numbers][width];
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
      using Pack                        = CellPack<dim, Number>;
      using Packs                       = std::array<Pack, dim>;
      constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
      constexpr unsigned int n_vertices = n_linear_nodes(dim);
      for (auto &node : y.values)
        node.fill(Pack(0));

      // rows: gradients of the coordinates of the reference cell
      std::array<Packs, dim> J             = {};
      const auto             load_jacobian = [&]() {
        for (Packs &row : J)
          for (Pack &entry : row)
            entry = load<dim>(numbers);
      };
      if (!curved)
        load_jacobian();
      for (const auto &point : rule.points)
        {
          if (curved)
            load_jacobian();
          const Pack                        JxW = load<dim>(numbers);
          const SymmetricPacks<dim, Number> H(numbers);

          std::array<Packs, dim> L;
          for (unsigned int i = 0; i < dim; ++i)
            {
              Packs slope;
              slope.fill(Pack(0));
              for (unsigned int a = 0; a < n_nodes; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  slope[d] += point.gradients[a][d] * x.values[a][i];
              for (unsigned int j = 0; j < dim; ++j)
                {
                  L[i][j] = slope[0] * J[0][j];
                  for (unsigned int d = 1; d < dim; ++d)
                    L[i][j] += slope[d] * J[d][j];
                }
            }
          Pack pressure(0), divergence(0);
          for (unsigned int v = 0; v < n_vertices; ++v)
            pressure += point.linear[v] * x.values[v][dim];
          for (unsigned int i = 0; i < dim; ++i)
            divergence += L[i][i];
          pressure *= JxW;
          divergence *= JxW;

          std::array<Packs, dim> S;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                S[i][j] = i == j ? -pressure : Pack(0);
                for (unsigned int k = 0; k < dim; ++k)
                  S[i][j] += transposed ? (L[i][k] + L[k][i]) * H[k][j] :
                                          L[i][k] * H[k][j] + H[i][k] * L[j][k];
              }
          if (with_tangents)
            {
              const Pack                        factor = load<dim>(numbers);
              const SymmetricPacks<dim, Number> B(numbers);
              Pack                              rate(0);
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  rate += B[i][j] * L[i][j];
              rate *= factor;
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  S[i][j] += rate * B[i][j];
            }

          for (unsigned int v = 0; v < n_vertices; ++v)
            y.values[v][dim] -= point.linear[v] * divergence;
          for (unsigned int i = 0; i < dim; ++i)
            {
              Packs flux;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  flux[d] = S[i][0] * J[d][0];
                  for (unsigned int j = 1; j < dim; ++j)
                    flux[d] += S[i][j] * J[d][j];
                }
              for (unsigned int a = 0; a < n_nodes; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  y.values[a][i] += point.gradients[a][d] * flux[d];
            }
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
    const bool         curved = group.batches->curved;
    const unsigned int n_points =
      reference_rule<dim, Number>(curved).points.size();
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

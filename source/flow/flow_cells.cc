#include <catena/flow/cell_kernels.h>
#include <catena/flow/flow_cells.h>

#include <cmath>
#include <utility>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowCells<dim>::FlowCells(const MovingMesh<dim> &mesh,
                            const Partitioner     &nodes)
    : places(mesh.cells().size())
  {
    for (const bool curved : {false, true})
      {
        std::vector<unsigned int> cells;
        for (unsigned int c = 0; c < mesh.cells().size(); ++c)
          if (mesh.cells()[c].owned && mesh.cells()[c].curved == curved)
            {
              places[c].group = groups.size();
              places[c].index = cells.size();
              cells.push_back(c);
            }
        if (cells.empty())
          continue;
        while (cells.size() % cells_at_once != 0)
          cells.push_back(cells.back());

        std::vector<unsigned int> batches;
        batches.reserve(cells.size() * n_quadratic_nodes(dim));
        for (unsigned int first = 0; first < cells.size();
             first += cells_at_once)
          for (unsigned int a = 0; a < n_quadratic_nodes(dim); ++a)
            for (unsigned int i = first; i < first + cells_at_once; ++i)
              batches.push_back(
                nodes.global_to_local(mesh.cells()[cells[i]].nodes[a]));
        groups.push_back({curved, std::move(batches), {}, {}});
      }
    resize();
  }



  /// Those of each cell of a group.
  template <int dim>
  unsigned int
  FlowCells<dim>::n_numbers(const Group &group) const
  {
    const bool         curved = group.curved;
    const unsigned int n_points =
      CellKernels::reference_rule<dim, float>(curved).size();
    constexpr unsigned int of_a_tensor = n_symmetric_components(dim);
    return (curved ? n_points : 1) * dim * dim +
           n_points * (1 + (scalar_viscosity ? 1 : of_a_tensor) +
                       (with_tangents ? 1 + of_a_tensor : 0));
  }



  template <int dim>
  void
  FlowCells<dim>::resize()
  {
    for (Group &group : groups)
      {
        const std::size_t n =
          group.nodes.size() / n_quadratic_nodes(dim) * n_numbers(group);
        group.numbers.assign(n, 0.f);
        group.remainders.assign(n, 0.f);
      }
  }



  template <int dim>
  void
  FlowCells<dim>::set_form(const bool new_scalar_viscosity,
                           const bool new_with_tangents)
  {
    if (scalar_viscosity == new_scalar_viscosity &&
        with_tangents == new_with_tangents)
      return;
    scalar_viscosity = new_scalar_viscosity;
    with_tangents    = new_with_tangents;
    resize();
  }



  template <int dim>
  void
  FlowCells<dim>::set(
    const unsigned int                                        cell,
    const std::vector<typename CellValues<dim>::PointValues> &points,
    const std::vector<StressCoefficients<dim>>               &coefficients)
  {
    constexpr unsigned int width = cells_at_once;
    const Place            place = places[cell];
    AssertIndexRange(place.group, groups.size());
    Group &group = groups[place.group];

    std::size_t next =
      std::size_t(place.index / width) * width * n_numbers(group) +
      place.index % width;
    const auto add = [&](const double number) {
      group.numbers[next]    = number;
      group.remainders[next] = number - group.numbers[next];
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
        if (group.curved || q == 0)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int j = 0; j < dim; ++j)
              add(points[q].linear_gradient[d + 1][j]);
        AssertThrow(with_tangents || coefficients[q].tangent_factor == 0.,
                    ExcMessage("A stress with a tangent has to say so: "
                               "override has_tangent()."));
        add(points[q].JxW);
        if (scalar_viscosity)
          {
            const double viscosity = coefficients[q].viscosity[0][0];
            // what is not finite is found by who looks at all cells
            AssertThrow(!std::isfinite(viscosity) ||
                          coefficients[q].viscosity ==
                            viscosity * unit_symmetric_tensor<dim>(),
                        ExcMessage("A stress with a tensor viscosity must not "
                                   "say that it has a scalar one."));
            add(points[q].JxW * viscosity);
          }
        else
          add_symmetric(points[q].JxW, coefficients[q].viscosity);
        if (with_tangents)
          {
            add(points[q].JxW * coefficients[q].tangent_factor);
            add_symmetric(1., coefficients[q].tangent);
          }
      }
  }



  namespace
  {
    template <int dim, typename Number, bool transposed>
    auto
    select_kernel(const bool curved, const bool scalar_viscosity)
    {
      using namespace CellKernels;
      // with a scalar viscosity the sums are those of their transpose
      if (scalar_viscosity)
        return curved ? &integrate<dim, Number, true, true, false> :
                        &integrate<dim, Number, false, true, false>;
      return curved ? &integrate<dim, Number, true, false, transposed> :
                      &integrate<dim, Number, false, false, transposed>;
    }
  } // namespace



  template <int dim>
  template <bool transposed, typename Number>
  void
  FlowCells<dim>::add(Number *dst, const Number *src) const
  {
    CellKernels::NodePacks<dim, Number> x, y;
    for (const Group &group : groups)
      {
        const auto &rule =
          CellKernels::reference_rule<dim, Number>(group.curved);
        const auto integrate =
          select_kernel<dim, Number, transposed>(group.curved,
                                                 scalar_viscosity);
        const unsigned int nodes_at_once =
                             n_quadratic_nodes(dim) * cells_at_once,
                           numbers_at_once = n_numbers(group) * cells_at_once;
        const unsigned int *nodes          = group.nodes.data();
        std::size_t         first          = 0;
        for (; nodes != group.nodes.data() + group.nodes.size();
             nodes += nodes_at_once, first += numbers_at_once)
          {
            const CellKernels::CellNumbers<dim, Number> numbers(
              group.numbers.data() + first, group.remainders.data() + first);
            x.gather(nodes, src);
            integrate(rule, with_tangents, numbers, x, y);
            y.scatter(nodes, dst);
          }
      }
  }



  template <int dim>
  template <typename Number>
  void
  FlowCells<dim>::add_product(Number *dst, const Number *src) const
  {
    add<false, Number>(dst, src);
  }



  template <int dim>
  template <typename Number>
  void
  FlowCells<dim>::add_transposed_product(Number *dst, const Number *src) const
  {
    add<true, Number>(dst, src);
  }



  template <int dim>
  template <typename Number>
  std::size_t
  FlowCells<dim>::bytes_of_a_product() const
  {
    std::size_t bytes = 0;
    for (const Group &group : groups)
      bytes += group.numbers.size() * sizeof(Number) +
               group.nodes.size() * sizeof(unsigned int);
    return bytes;
  }



#define INSTANTIATE(dim, Number)                                              \
  template void FlowCells<dim>::add_product(Number *, const Number *) const;  \
  template void FlowCells<dim>::add_transposed_product(Number *,              \
                                                       const Number *) const; \
  template std::size_t FlowCells<dim>::bytes_of_a_product<Number>() const;
  template class FlowCells<2>;
  template class FlowCells<3>;
  INSTANTIATE(2, double)
  INSTANTIATE(2, float)
  INSTANTIATE(3, double)
  INSTANTIATE(3, float)
#undef INSTANTIATE
} // namespace Catena

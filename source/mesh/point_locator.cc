#include <catena/mesh/point_locator.h>
#include <catena/mesh/quadratic_shape.h>

#include <algorithm>
#include <limits>

namespace Catena
{
  using dealii::BoundingBox;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    namespace bgi = boost::geometry::index;

    /// boxes are larger than their nodes by this share on each side
    constexpr double padding = 0.05;

    /// a violation up to this is round-off: the search ends
    constexpr double inside = 1e-12;

    /// with a violation above this the nearest cells are tried as well
    constexpr double outside = 0.02;

    /// how many of the nearest cells are tried
    constexpr unsigned int n_nearest = 16;

    constexpr unsigned int max_newton_steps = 20;

    template <int dim>
    using CellNodes = typename PointLocator<dim>::CellNodes;



    template <int dim>
    BoundingBox<dim>
    padded_box(const CellNodes<dim> &x)
    {
      Point<dim> low = x[0], high = x[0];
      for (const auto &p : x)
        for (unsigned int d = 0; d < dim; ++d)
          {
            low[d]  = std::min(low[d], p[d]);
            high[d] = std::max(high[d], p[d]);
          }
      const Tensor<1, dim> pad = padding * (high - low);
      return BoundingBox<dim>(std::make_pair(low - pad, high + pad));
    }



    template <int dim>
    bool
    is_curved(const CellNodes<dim> &x)
    {
      double deviation = 0., size = 0.;
      for (unsigned int i = dim + 1; i < x.size(); ++i)
        {
          const auto        edge = simplex_edge(i - dim - 1);
          const Point<dim> &a    = x[edge[0]];
          const Point<dim> &b    = x[edge[1]];
          deviation = std::max(deviation, (a + (b - a) / 2.).distance(x[i]));
          size      = std::max(size, a.distance(b));
        }
      return deviation > 1e-12 * size;
    }



    /// The point in the simplex of the vertices.
    template <int dim>
    Point<dim>
    affine_inverse(const CellNodes<dim> &x, const Point<dim> &p)
    {
      Tensor<2, dim> jacobian;
      for (unsigned int v = 0; v < dim; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          jacobian[d][v] = x[v + 1][d] - x[0][d];
      return Point<dim>(dealii::invert(jacobian) * (p - x[0]));
    }



    /**
     * The point in the quadratic simplex by Newton's method. Where that does
     * not converge, as it may far from the cell, @p start.
     */
    template <int dim>
    Point<dim>
    quadratic_inverse(const CellNodes<dim> &x,
                      const Point<dim>     &p,
                      const Point<dim>     &start)
    {
      Point<dim> unit = start;
      for (unsigned int step = 0; step < max_newton_steps; ++step)
        {
          const auto     values    = quadratic_shape_values<dim>(unit);
          const auto     gradients = quadratic_shape_gradients<dim>(unit);
          Tensor<1, dim> residual  = p;
          Tensor<2, dim> jacobian;
          for (unsigned int i = 0; i < x.size(); ++i)
            {
              residual -= values[i] * x[i];
              for (unsigned int d = 0; d < dim; ++d)
                jacobian[d] += x[i][d] * gradients[i];
            }
          if (dealii::determinant(jacobian) == 0.)
            return start;

          const Tensor<1, dim> update = dealii::invert(jacobian) * residual;
          unit += update;
          if (update.norm() < 1e-13)
            return unit;
          if (!(unit.distance(start) < 1. + start.norm()))
            return start;
        }
      return start;
    }



    template <int dim>
    double
    violation_of(const Point<dim> &unit)
    {
      double violation = 0.;
      for (const double lambda : barycentric_coordinates(unit))
        violation = std::max(violation, -lambda);
      return violation;
    }
  } // namespace



  template <int dim>
  PointLocator<dim>::PointLocator(std::vector<CellNodes> cell_nodes)
    : nodes(std::move(cell_nodes))
  {
    std::vector<Entry> entries;
    entries.reserve(nodes.size());
    curved.reserve(nodes.size());
    for (const auto &x : nodes)
      {
        entries.emplace_back(padded_box<dim>(x), entries.size());
        curved.push_back(is_curved<dim>(x));
      }
    tree = dealii::pack_rtree(entries);
  }



  template <int dim>
  typename PointLocator<dim>::Location
  PointLocator<dim>::locate_in(const unsigned int cell,
                               const Point<dim>  &p) const
  {
    Location location;
    location.cell = cell;
    location.unit = affine_inverse<dim>(nodes[cell], p);
    if (curved[cell])
      location.unit = quadratic_inverse<dim>(nodes[cell], p, location.unit);
    location.violation = violation_of(location.unit);
    return location;
  }



  template <int dim>
  typename PointLocator<dim>::Location
  PointLocator<dim>::locate(const Point<dim> &p) const
  {
    Location best;
    best.cell      = dealii::numbers::invalid_unsigned_int;
    best.violation = std::numeric_limits<double>::infinity();

    const auto try_cells = [&](auto query) {
      for (; query != tree.qend() && best.violation > inside; ++query)
        {
          const Location location = locate_in(query->second, p);
          if (location.violation < best.violation)
            best = location;
        }
    };

    try_cells(tree.qbegin(bgi::intersects(p)));
    if (best.violation > outside)
      try_cells(tree.qbegin(bgi::nearest(p, n_nearest)));
    return best;
  }



  template class PointLocator<2>;
  template class PointLocator<3>;
} // namespace Catena

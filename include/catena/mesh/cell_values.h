#ifndef catena_mesh_cell_values_h
#define catena_mesh_cell_values_h

#include <catena/base/pack.h>
#include <catena/base/types.h>
#include <catena/mesh/node_numbers.h>

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Catena
{
  /**
   * Values and gradients of the P2 and P1 shape functions at the quadrature
   * points of one quadratic simplex, for the assembly loops.
   *
   * Straight cells are integrated with a rule exact for degree 2 (exact for
   * the viscous and the divergence terms), curved ones with degree 5. Pass a
   * rule of your own to integrate data of higher degree.
   */
  template <int dim>
  class CellValues
  {
  public:
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    using NodePositions = std::array<dealii::Point<dim>, n_nodes>;

    /// What is known at one quadrature point.
    struct PointValues
    {
      double                                         JxW;
      NodeNumbers<dim>                               quadratic;
      NodeVectors<dim>                               quadratic_gradient;
      std::array<double, n_vertices>                 linear;
      std::array<dealii::Tensor<1, dim>, n_vertices> linear_gradient;
    };

    /**
     * What is known of the linear shape functions at some points at once,
     * those from number @p first on. Lanes beyond the last point have its shape
     * functions and a JxW of zero.
     */
    struct PackValues
    {
      unsigned int                                         first, n_points;
      Pack                                                 JxW;
      std::array<Pack, n_vertices>                         linear;
      std::array<dealii::Tensor<1, dim, Pack>, n_vertices> linear_gradient;
    };

    /// The rule of straight or curved cells.
    static dealii::Quadrature<dim>
    rule(const bool curved);

    CellValues();

    /// It refers to rules of its own.
    CellValues(const CellValues &) = delete;

    explicit CellValues(const dealii::Quadrature<dim> &quadrature);

    /**
     * Move to a cell. @p curved tells whether its mid-nodes may lie off the
     * middle of their edges.
     */
    void
    reinit(const NodePositions &positions, const bool curved);

    const std::vector<PointValues> &
    points() const
    {
      return active->values;
    }

    /// The same points, some at once.
    const std::vector<PackValues> &
    packs() const
    {
      return active->packs;
    }

  private:
    /// Shape functions on the reference simplex at one point.
    struct ReferencePoint
    {
      double                                         weight;
      NodeVectors<dim>                               quadratic_gradient;
      std::array<dealii::Tensor<1, dim>, n_vertices> linear_gradient;
    };

    struct Rule
    {
      std::vector<ReferencePoint> reference;
      std::vector<PointValues>    values;
      std::vector<PackValues>     packs;

      void
      tabulate(const dealii::Quadrature<dim> &quadrature);

      /// The point of a lane, the last one for lanes beyond.
      const PointValues &
      point(const PackValues &pack, const unsigned int lane) const
      {
        return values[pack.first + std::min(lane, pack.n_points - 1)];
      }

      void
      update_packs(const bool curved);
    };

    Rule        straight_rule, curved_rule;
    const Rule *active = nullptr;
  };
} // namespace Catena

#endif

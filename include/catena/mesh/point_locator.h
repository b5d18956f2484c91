#ifndef catena_mesh_point_locator_h
#define catena_mesh_point_locator_h

#include <catena/base/types.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <deal.II/numerics/rtree.h>

#include <array>
#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Finds the cell of a mesh of quadratic simplices that a point lies in.
   *
   * The boxes of the cells, padded by 5 %, are kept in a tree; in the cells
   * whose box holds the point the quadratic map is inverted by Newton's method.
   */
  template <int dim>
  class PointLocator
  {
  public:
    /// Nodes of a cell in the order of FE_SimplexP(2).
    using CellNodes = std::array<dealii::Point<dim>, n_quadratic_nodes(dim)>;

    explicit PointLocator(std::vector<CellNodes> nodes);

    struct Location
    {
      /// place of the cell in the list given to the constructor
      unsigned int cell;
      /// the point in the reference simplex
      dealii::Point<dim> unit;
      /// how far outside of the reference simplex, in its coordinates; 0 inside
      double violation;
    };

    /**
     * The cell with the smallest violation. A point that lies in no cell, as
     * beside a curved boundary, is given the best of the cells near it; it is
     * for the caller to judge how much violation is acceptable.
     */
    Location
    locate(const dealii::Point<dim> &p) const;

    /// Where it is in the reference simplex of this cell.
    Location
    locate_in(const unsigned int cell, const dealii::Point<dim> &p) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    std::vector<CellNodes> nodes;
    std::vector<char>      curved;
    dealii::RTree<Entry>   tree;
  };
} // namespace Catena

#endif

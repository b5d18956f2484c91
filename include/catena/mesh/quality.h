#ifndef catena_mesh_quality_h
#define catena_mesh_quality_h

#include <catena/base/types.h>

#include <deal.II/base/point.h>

#include <array>

namespace Catena
{
  /**
   * Quality of a straight-sided simplex: dim times the radius of the inscribed
   * sphere over that of the circumscribed one. It is 1 for the regular
   * simplex, 0 for a flat one and negative for an inverted one.
   */
  template <int dim>
  double
  simplex_quality(const std::array<dealii::Point<dim>, dim + 1> &vertices);

  /**
   * Quality of a quadratic simplex with nodes in the order of FE_SimplexP(2):
   * that of its vertices, but -1 if its curved sides invert it at a node.
   */
  template <int dim>
  double
  quadratic_simplex_quality(
    const std::array<dealii::Point<dim>, n_quadratic_nodes(dim)> &nodes);

  /**
   * Signed volume (area for dim = 2) of a straight-sided simplex, positive for
   * deal.II's order of the vertices.
   */
  template <int dim>
  double
  simplex_volume(const std::array<dealii::Point<dim>, dim + 1> &vertices);
} // namespace Catena

#endif

#ifndef catena_base_types_h
#define catena_base_types_h

#include <deal.II/lac/la_parallel_block_vector.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace Catena
{
  /// A distributed field with ghost values.
  using VectorType = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Velocity, pressure, rigid-body motions and contact forces together.
  using BlockVectorType =
    dealii::LinearAlgebra::distributed::BlockVector<double>;

  /// The same in single precision, for what is not more than a correction.
  using FastVectorType = dealii::LinearAlgebra::distributed::Vector<float>;
  using FastBlockVectorType =
    dealii::LinearAlgebra::distributed::BlockVector<float>;

  /// Number of P2 nodes of a simplex.
  constexpr unsigned int
  n_quadratic_nodes(const int dim)
  {
    return (dim + 1) * (dim + 2) / 2;
  }

  /// Number of P1 nodes (vertices) of a simplex.
  constexpr unsigned int
  n_linear_nodes(const int dim)
  {
    return dim + 1;
  }

  /// Independent components of a symmetric tensor, in deal.II's order
  /// (xx, yy, zz, xy, xz, yz or xx, yy, xy).
  constexpr unsigned int
  n_symmetric_components(const int dim)
  {
    return dim * (dim + 1) / 2;
  }
} // namespace Catena

#endif

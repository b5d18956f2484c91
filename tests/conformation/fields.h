#ifndef catena_tests_conformation_fields_h
#define catena_tests_conformation_fields_h

#include <catena/base/types.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/mesher.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/scene/scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    template <int dim>
    using TensorFunction = std::function<dealii::SymmetricTensor<2, dim>(
      const dealii::Point<dim> &)>;

    template <int dim>
    using VectorFunction =
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;



    /// A mesh of a block without particles, with elements of size @p h.
    template <int dim>
    MeshDescription<dim>
    uniform_mesh(const Scene<dim> &scene, const double h)
    {
      MeshParameters parameters;
      parameters.maximal_size = h;
      return generate_mesh<dim>(scene, parameters);
    }



    /// The P2 interpolant of a vector at the nodes at @p positions.
    template <int dim>
    VectorType
    interpolate_vector(const MovingMesh<dim>     &mesh,
                       const VectorType          &positions,
                       const VectorFunction<dim> &function)
    {
      VectorType field = mesh.vector_field();
      for (const auto node : mesh.owned_nodes())
        {
          const auto value = function(node_position<dim>(positions, node));
          for (unsigned int d = 0; d < dim; ++d)
            field(dim * node + d) = value[d];
        }
      field.update_ghost_values();
      return field;
    }



    /// The P1 interpolant of a tensor, by components.
    template <int dim>
    std::vector<VectorType>
    interpolate_tensor(const MovingMesh<dim>     &mesh,
                       const VectorType          &positions,
                       const TensorFunction<dim> &function)
    {
      constexpr unsigned int  n = n_symmetric_components(dim);
      std::vector<VectorType> field(n, mesh.scalar_field());
      for (const auto vertex : mesh.owned_scalars())
        {
          const auto value = function(
            node_position<dim>(positions, mesh.node_of_vertex(vertex)));
          for (unsigned int k = 0; k < n; ++k)
            field[k](vertex) = value.access_raw_entry(k);
        }
      for (VectorType &component : field)
        component.update_ghost_values();
      return field;
    }



    /// Largest difference at a vertex of a field to a function.
    template <int dim>
    double
    largest_error(const MovingMesh<dim>         &mesh,
                  const VectorType              &positions,
                  const std::vector<VectorType> &field,
                  const TensorFunction<dim>     &function)
    {
      const auto expected = interpolate_tensor<dim>(mesh, positions, function);
      double     error    = 0.;
      for (const auto vertex : mesh.owned_scalars())
        for (unsigned int k = 0; k < field.size(); ++k)
          {
            const double e = std::abs(field[k](vertex) - expected[k](vertex));
            error          = std::max(error, std::isfinite(e) ? e : 1e300);
          }
      return dealii::Utilities::MPI::max(error, mesh.communicator());
    }



    /// Root of the mean square, over the volume, of the error of a field.
    template <int dim>
    double
    mean_error(const MovingMesh<dim>         &mesh,
               const std::vector<VectorType> &field,
               const TensorFunction<dim>     &function)
    {
      CellValues<dim> values(dealii::QGaussSimplex<dim>(4));
      double          square = 0., volume = 0.;
      for (const auto &cell : mesh.cells())
        if (cell.owned)
          {
            const auto nodes = mesh.cell_positions(cell, mesh.positions());
            const auto s     = vertex_tensors<dim>(cell, field);
            values.reinit(nodes, cell.curved);
            for (const auto &point : values.points())
              {
                dealii::Point<dim>              x;
                dealii::SymmetricTensor<2, dim> error;
                for (unsigned int a = 0; a < nodes.size(); ++a)
                  x += point.quadratic[a] * dealii::Tensor<1, dim>(nodes[a]);
                for (unsigned int v = 0; v < s.size(); ++v)
                  error += point.linear[v] * s[v];
                error -= function(x);
                square += point.JxW * (error * error);
                volume += point.JxW;
              }
          }
      square = dealii::Utilities::MPI::sum(square, mesh.communicator());
      volume = dealii::Utilities::MPI::sum(volume, mesh.communicator());
      return std::sqrt(square / volume);
    }
  } // namespace Tests
} // namespace Catena

#endif

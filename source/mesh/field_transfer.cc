#include <catena/base/exceptions.h>
#include <catena/mesh/field_transfer.h>
#include <catena/mesh/point_locator.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// The entries of all ranks, in the order of ranks.
    template <typename T>
    std::vector<T>
    gather(const std::vector<T> &mine, const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return mine;
      std::vector<T> all;
      for (const auto &part : Utilities::MPI::all_gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }
  } // namespace



  template <int dim>
  FieldTransfer<dim>::FieldTransfer(const MovingMesh<dim> &source,
                                    const VectorType      &source_positions,
                                    const MovingMesh<dim> &target,
                                    const VectorType      &target_positions)
    : source(source)
    , target(target)
  {
    std::vector<std::array<Point<dim>, n_nodes>> cells;
    for (const auto &cell : source.cells())
      if (cell.owned)
        cells.push_back(source.cell_positions(cell, source_positions));
    const PointLocator<dim> locator(gather(cells, source.communicator()));

    const FE_SimplexP<dim> quadratic(2), linear(1);
    const bool             rotational = source.scene().rotational();
    double                 farthest   = 0.;
    for (const auto node : target.owned_nodes())
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = target_positions(dim * node + d);

        typename PointLocator<dim>::Location location;
        bool                                 turned = false;
        location.violation = std::numeric_limits<double>::max();
        const auto images  = source.scene().rotated_images(x);
        for (unsigned int k = 0; k < images.size(); ++k)
          {
            const auto candidate = locator.locate(images[k]);
            if (candidate.violation < location.violation)
              {
                location = candidate;
                turned   = rotational && k % 2 == 1;
              }
            if (location.violation < 1e-10)
              break;
          }
        farthest = std::max(farthest, location.violation);

        Place place;
        place.node   = node;
        place.cell   = location.cell;
        place.turned = turned;
        for (unsigned int i = 0; i < n_nodes; ++i)
          place.quadratic[i] = quadratic.shape_value(i, location.unit);
        for (unsigned int i = 0; i < n_vertices; ++i)
          place.linear[i] = linear.shape_value(i, location.unit);
        places.push_back(place);
      }
    farthest = Utilities::MPI::max(farthest, target.communicator());
    if (farthest > 0.1)
      throw MeshError("A node of the new mesh lies " +
                      std::to_string(farthest) +
                      " elements outside of the old one.");
  }



  template <int dim>
  VectorType
  FieldTransfer<dim>::vector(const VectorType &field) const
  {
    std::vector<std::array<double, n_nodes * dim>> values;
    for (const auto &cell : source.cells())
      if (cell.owned)
        {
          values.emplace_back();
          for (unsigned int a = 0; a < n_nodes; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              values.back()[dim * a + d] = field(dim * cell.nodes[a] + d);
        }
    values = gather(values, source.communicator());

    VectorType result = target.vector_field();
    for (const Place &place : places)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double value = 0.;
          for (unsigned int a = 0; a < n_nodes; ++a)
            value += place.quadratic[a] * values[place.cell][dim * a + d];
          result(dim * place.node + d) =
            place.turned && d < 2 ? -value : value;
        }
    result.update_ghost_values();
    return result;
  }



  template <int dim>
  std::vector<std::array<double, FieldTransfer<dim>::n_vertices>>
  FieldTransfer<dim>::gather_vertex_values(const VectorType &field) const
  {
    std::vector<std::array<double, n_vertices>> values;
    for (const auto &cell : source.cells())
      if (cell.owned)
        {
          values.emplace_back();
          for (unsigned int v = 0; v < n_vertices; ++v)
            values.back()[v] = field(cell.vertices[v]);
        }
    return gather(values, source.communicator());
  }



  /**
   * @param odd the field changes sign under the rotation
   */
  template <int dim>
  VectorType
  FieldTransfer<dim>::scalar(const VectorType &field, const bool odd) const
  {
    const auto values = gather_vertex_values(field);
    VectorType result = target.scalar_field();
    for (const Place &place : places)
      {
        const unsigned int vertex = target.vertex_of_node(place.node);
        if (vertex == numbers::invalid_unsigned_int ||
            !target.owned_scalars().is_element(vertex))
          continue;
        double value = 0.;
        for (unsigned int v = 0; v < n_vertices; ++v)
          value += place.linear[v] * values[place.cell][v];
        result(vertex) = odd && place.turned ? -value : value;
      }
    result.update_ghost_values();
    return result;
  }



  template <int dim>
  VectorType
  FieldTransfer<dim>::scalar(const VectorType &field) const
  {
    return scalar(field, false);
  }



  template <int dim>
  std::vector<VectorType>
  FieldTransfer<dim>::tensor(const std::vector<VectorType> &components) const
  {
    std::vector<VectorType> result;
    for (unsigned int k = 0; k < components.size(); ++k)
      {
        const auto ij =
          SymmetricTensor<2, dim>::unrolled_to_component_indices(k);
        result.push_back(scalar(components[k], (ij[0] < 2) != (ij[1] < 2)));
      }
    return result;
  }



  template class FieldTransfer<2>;
  template class FieldTransfer<3>;
} // namespace Catena

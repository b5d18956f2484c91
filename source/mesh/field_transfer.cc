#include <catena/base/exceptions.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/field_transfer.h>
#include <catena/mesh/linear_fit.h>
#include <catena/mesh/quadratic_shape.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <limits>

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
      const double bytes =
        Utilities::MPI::sum(double(mine.size()) * sizeof(T), communicator);
      if (bytes > std::numeric_limits<int>::max())
        throw MeshError("A mesh has too many cells to be replaced on several "
                        "processes: take one process.");
      std::vector<T> all;
      for (const auto &part : Utilities::MPI::all_gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }
  } // namespace



  namespace
  {
    /// Nodes of all cells of a mesh, on every rank.
    template <int dim>
    std::vector<typename PointLocator<dim>::CellNodes>
    all_cell_nodes(const MovingMesh<dim> &mesh, const VectorType &positions)
    {
      std::vector<typename PointLocator<dim>::CellNodes> cells;
      for (const auto &cell : mesh.cells())
        if (cell.owned)
          cells.push_back(mesh.cell_positions(cell, positions));
      return gather(cells, mesh.communicator());
    }
  } // namespace



  namespace
  {
    /// A tensor on a turned image as it is on the original.
    template <int dim>
    SymmetricTensor<2, dim>
    turned(SymmetricTensor<2, dim> tensor)
    {
      for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
        if (changes_sign_about_z<dim>(k))
          tensor.access_raw_entry(k) *= -1.;
      return tensor;
    }
  } // namespace



  template <int dim>
  FieldTransfer<dim>::FieldTransfer(const MovingMesh<dim> &source,
                                    const VectorType      &source_positions,
                                    const MovingMesh<dim> &target,
                                    const VectorType      &target_positions)
    : source(source)
    , target(target)
    , target_positions(target_positions)
    , images(source.scene().images())
    , locator(all_cell_nodes<dim>(source, source_positions))
  {
    this->target_positions.update_ghost_values();
    double farthest = 0.;
    for (const auto node : target.owned_nodes())
      {
        double violation = 0.;
        node_places.push_back(
          find(node_position<dim>(target_positions, node), violation));
        farthest = std::max(farthest, violation);
      }
    farthest = Utilities::MPI::max(farthest, target.communicator());
    // the surfaces of the two meshes differ by a small part of an element, of a
    // flat element by a larger one
    if (farthest > 1.)
      throw MeshError("A node of the new mesh lies " +
                      std::to_string(farthest) +
                      " elements outside of the old one.");
  }



  template <int dim>
  typename FieldTransfer<dim>::Place
  FieldTransfer<dim>::find(const Point<dim> &point, double &violation) const
  {
    Place place{};
    violation = std::numeric_limits<double>::max();
    for (const Image<dim> &image : images)
      {
        const auto location = locator.locate(image(point));
        if (location.violation < violation)
          {
            violation = location.violation;
            place     = {location.cell, location.unit, image.turned};
          }
        if (violation < 1e-10)
          break;
      }
    return place;
  }



  template <int dim>
  typename FieldTransfer<dim>::Place
  FieldTransfer<dim>::find(const Point<dim>          &point,
                           std::vector<unsigned int> &cells_nearby) const
  {
    for (const unsigned int cell : cells_nearby)
      {
        const auto location = locator.locate_in(cell, point);
        if (location.violation == 0.)
          return {cell, location.unit, false};
      }
    double      violation;
    const Place place = find(point, violation);
    if (!place.turned)
      cells_nearby.push_back(place.cell);
    return place;
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
    auto       place  = node_places.begin();
    for (const auto node : target.owned_nodes())
      {
        const auto shapes = quadratic_shape_values<dim>(place->unit);
        for (unsigned int d = 0; d < dim; ++d)
          {
            double value = 0.;
            for (unsigned int a = 0; a < n_nodes; ++a)
              value += shapes[a] * values[place->cell][dim * a + d];
            result(dim * node + d) = place->turned && d < 2 ? -value : value;
          }
        ++place;
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



  template <int dim>
  VectorType
  FieldTransfer<dim>::scalar(const VectorType &field, const bool odd) const
  {
    const auto values = gather_vertex_values(field);
    VectorType result = target.scalar_field();
    auto       place  = node_places.begin();
    for (const auto node : target.owned_nodes())
      {
        const unsigned int vertex = target.vertex_of_node(node);
        if (vertex != numbers::invalid_unsigned_int &&
            target.owned_scalars().is_element(vertex))
          {
            const auto shapes = barycentric_coordinates<dim>(place->unit);
            double     value  = 0.;
            for (unsigned int v = 0; v < n_vertices; ++v)
              value += shapes[v] * values[place->cell][v];
            result(vertex) = odd && place->turned ? -value : value;
          }
        ++place;
      }
    result.update_ghost_values();
    return result;
  }



  template <int dim>
  std::vector<VectorType>
  FieldTransfer<dim>::tensor(const std::vector<VectorType> &components) const
  {
    // sized first: a vector copied when the list grows loses its ghost values
    std::vector<VectorType> result(components.size());
    for (unsigned int k = 0; k < components.size(); ++k)
      result[k] = scalar(components[k], changes_sign_about_z<dim>(k));
    return result;
  }



  template <int dim>
  std::vector<typename FieldTransfer<dim>::CellTensors>
  FieldTransfer<dim>::gather_cell_tensors(
    const std::vector<VectorType> &components,
    const PointTensors<dim>       &tensors) const
  {
    const std::array<LinearFit<dim>, 2> fits = {
      {LinearFit<dim>(CellValues<dim>::rule(false)),
       LinearFit<dim>(CellValues<dim>::rule(true))}};
    std::vector<CellTensors> result;
    for (const auto &cell : source.cells())
      if (cell.owned)
        {
          result.push_back({{vertex_tensors<dim>(cell, components), {}}});
          if (!tensors.empty())
            result.back()[1] = fits[cell.curved].values(tensors.of_cell(cell));
        }
    return gather(result, source.communicator());
  }



  template <int dim>
  typename FieldTransfer<dim>::AtPoints
  FieldTransfer<dim>::conserved_at_points(
    const std::vector<VectorType> &components,
    const TensorFunction          &function,
    const PointTensors<dim>       &tensors) const
  {
    struct Rule
    {
      LinearFit<dim>                           fit;
      std::vector<std::array<double, n_nodes>> quadratic;

      explicit Rule(const Quadrature<dim> &quadrature)
        : fit(quadrature)
      {
        for (const Point<dim> &x : quadrature.get_points())
          quadratic.push_back(quadratic_shape_values<dim>(x));
      }
    };
    const Rule straight_rule(CellValues<dim>::rule(false)),
      curved_rule(CellValues<dim>::rule(true)),
      many_points(QWitherdenVincentSimplex<dim>(4));

    const auto cells = gather_cell_tensors(components, tensors);
    AtPoints   result;
    for (const auto &cell : target.cells())
      {
        const auto nodes = target.cell_positions(cell, target_positions);
        std::vector<unsigned int> cells_nearby;
        const auto                evaluate = [&](const Rule &rule) {
          AtPoints values;
          for (const auto &shapes : rule.quadratic)
            {
              Point<dim> x;
              for (unsigned int a = 0; a < n_nodes; ++a)
                x += shapes[a] * Tensor<1, dim>(nodes[a]);
              const Place place = find(x, cells_nearby);
              const auto  lambda = barycentric_coordinates<dim>(place.unit);
              const auto  at_place = [&](const VertexTensors &vertices) {
                SymmetricTensor<2, dim> value;
                for (unsigned int v = 0; v < n_vertices; ++v)
                  value += lambda[v] * vertices[v];
                return place.turned ? turned<dim>(value) : value;
              };
              const auto &[of_field, of_points] = cells[place.cell];
              values.of_field.push_back(function(at_place(of_field)));
              values.of_points.push_back(at_place(of_points));
            }
          return values;
        };

        // c stays positive in the mean: the rule of a curved cell has many
        // points
        AtPoints values = evaluate(cell.curved ? curved_rule : many_points);
        for (Tensors *of : {&values.of_field, &values.of_points})
          if (!cell.curved)
            *of = straight_rule.fit.at_points(many_points.fit.values(*of));
        result.of_field.insert(result.of_field.end(),
                               values.of_field.begin(),
                               values.of_field.end());
        result.of_points.insert(result.of_points.end(),
                                values.of_points.begin(),
                                values.of_points.end());
      }
    return result;
  }



  template class FieldTransfer<2>;
  template class FieldTransfer<3>;
} // namespace Catena

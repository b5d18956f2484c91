#include <catena/base/on_root.h>
#include <catena/mesh/field_archive.h>

#include <cmath>
#include <cstdint>

namespace Catena
{
  using namespace dealii;

  /// The global index of each value in the order in which it is archived.
  template <int dim>
  std::vector<unsigned int>
  FieldArchive<dim>::vector_order() const
  {
    std::vector<unsigned int> order;
    order.reserve(dim * mesh.n_global_nodes());
    for (const unsigned int node : mesh.node_order())
      for (unsigned int d = 0; d < dim; ++d)
        order.push_back(dim * node + d);
    return order;
  }



  template <int dim>
  std::vector<unsigned int>
  FieldArchive<dim>::scalar_order() const
  {
    std::vector<unsigned int> order;
    for (const unsigned int node : mesh.node_order())
      if (mesh.vertex_of_node(node) != numbers::invalid_unsigned_int)
        order.push_back(mesh.vertex_of_node(node));
    return order;
  }



  template <int dim>
  void
  FieldArchive<dim>::save(const VectorType                &field,
                          const std::vector<unsigned int> &order)
  {
    // ranks own contiguous ranges in their order
    const std::vector<double> values =
      on_root(field.begin(), field.locally_owned_size(), mesh.communicator());
    std::vector<double> ordered(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      ordered[i] = values[order[i]];
    archive(ordered);
  }



  template <int dim>
  void
  FieldArchive<dim>::load(VectorType                      &field,
                          const std::vector<unsigned int> &order,
                          const VectorType                &layout)
  {
    std::vector<double> ordered;
    archive(ordered);
    if (ordered.empty())
      {
        field = VectorType();
        return;
      }
    if (ordered.size() != order.size())
      throw CheckpointError(
        "it has a field of " + std::to_string(ordered.size()) +
        " values on a mesh with " + std::to_string(order.size()));
    const bool with_ghost_values = field.size() == 0;
    if (with_ghost_values)
      field = layout;
    for (std::size_t i = 0; i < order.size(); ++i)
      {
        if (!std::isfinite(ordered[i]))
          throw CheckpointError("it has values that are not finite");
        if (field.in_local_range(order[i]))
          field(order[i]) = ordered[i];
      }
    if (with_ghost_values)
      field.update_ghost_values();
  }



  template <int dim>
  void
  FieldArchive<dim>::vector(VectorType &field)
  {
    if (is_loading())
      load(field, vector_order(), mesh.vector_field());
    else
      save(field, vector_order());
  }



  template <int dim>
  void
  FieldArchive<dim>::scalar(VectorType &field)
  {
    if (is_loading())
      load(field, scalar_order(), mesh.scalar_field());
    else
      save(field, scalar_order());
  }



  template <int dim>
  void
  FieldArchive<dim>::scalars(std::vector<VectorType> &fields)
  {
    std::uint32_t n = fields.size();
    archive(n);
    if (n != 0 && n != n_symmetric_components(dim))
      throw CheckpointError("it has a tensor of " + std::to_string(n) +
                            " components");
    // sized first: a vector copied when the list grows loses its ghost values
    fields.resize(n);
    for (VectorType &field : fields)
      {
        scalar(field);
        if (is_loading() && field.size() == 0)
          throw CheckpointError("a component of a tensor is missing");
      }
  }



  template class FieldArchive<2>;
  template class FieldArchive<3>;
} // namespace Catena

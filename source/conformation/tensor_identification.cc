#include <catena/conformation/tensor_identification.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  TensorIdentification<dim>::TensorIdentification(const MovingMesh<dim> &mesh)
    : masters(mesh.scalar_dofs().n_dofs(), 0)
  {
    for (auto &factors : component_factors)
      factors.assign(masters.size(), 0);
    const NodeIdentification &identification = mesh.identification();
    for (const auto vertex : mesh.relevant_scalars())
      {
        const unsigned int node = mesh.node_of_vertex(vertex);
        masters[vertex]         = mesh.vertex_master(vertex);
        for (unsigned int k = 0; k < component_factors.size(); ++k)
          {
            // what changes its sign about z does so at a mirror, too
            if (!changes_sign_about_z<dim>(k) || !mesh.on_mirror(node))
              component_factors[k][vertex] = static_cast<signed char>(
                identification.template tensor_factor<dim>(node, k));
          }
      }
  }



  template <int dim>
  VectorType
  TensorIdentification<dim>::field(const unsigned int     component,
                                   const MovingMesh<dim> &mesh,
                                   const VectorType      &values) const
  {
    VectorType of_masters = mesh.scalar_field();
    of_masters.copy_locally_owned_data_from(values);
    of_masters.update_ghost_values();
    VectorType result = mesh.scalar_field();
    for (const auto i : mesh.owned_scalars())
      result(i) = factor(component, i) * of_masters(masters[i]);
    result.update_ghost_values();
    return result;
  }



  template <int dim>
  std::vector<VectorType>
  TensorIdentification<dim>::fields(const MovingMesh<dim> &mesh,
                                    const BlockVectorType &values) const
  {
    // sized first: a vector copied when the list grows loses its ghost values
    std::vector<VectorType> result(n_symmetric_components(dim));
    for (unsigned int k = 0; k < result.size(); ++k)
      result[k] = field(k, mesh, values.block(k));
    return result;
  }



  template <int dim>
  BlockVectorType
  TensorIdentification<dim>::zero(const MovingMesh<dim> &mesh)
  {
    BlockVectorType result(n_symmetric_components(dim));
    for (unsigned int k = 0; k < result.n_blocks(); ++k)
      result.block(k).reinit(mesh.owned_scalars(), mesh.communicator());
    result.collect_sizes();
    return result;
  }



  template class TensorIdentification<2>;
  template class TensorIdentification<3>;
} // namespace Catena

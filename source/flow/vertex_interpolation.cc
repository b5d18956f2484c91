#include <catena/flow/vertex_interpolation.h>

#include <deal.II/base/mpi.h>


namespace Catena
{
  using namespace dealii;

  template <int dim>
  VertexInterpolation<dim>::VertexInterpolation(
    const MovingMesh<dim>                        &mesh,
    const std::vector<NodeCoupling<dim>>         &couplings,
    const std::vector<std::vector<unsigned int>> &groups)
    : prolongations(groups.size())
  {
    for (const auto node : mesh.owned_nodes())
      {
        FieldMask mask = 0;
        for (unsigned int component = 0; component < dim; ++component)
          if (couplings[node].is_unknown(node, component))
            mask |= 1U << component;
        node_masks.push_back(mask);
        if (mask != 0 && mesh.is_vertex(node))
          vertex_masks.push_back(mask);
      }

    // vertices are numbered rank by rank
    unsigned int next =
      first_of_ranks(vertex_masks.size(),
                     mesh.communicator())[Utilities::MPI::this_mpi_process(
        mesh.communicator())];
    VectorType   numbers(mesh.owned_nodes(),
                       mesh.relevant_nodes(),
                       mesh.communicator());
    unsigned int i = 0;
    for (const auto node : mesh.owned_nodes())
      if (node_masks[i++] != 0 && mesh.is_vertex(node))
        numbers(node) = next++;
    numbers.update_ghost_values();

    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        SparseRows &rows = prolongations[g];
        i                = 0;
        for (const auto node : mesh.owned_nodes())
          {
            if (node_masks[i++] == 0)
              {}
            else if (mesh.is_vertex(node))
              rows.add(numbers(node), 1.f);
            else
              for (const unsigned int end : mesh.edge_ends(node))
                if (couplings[end].has_unknown())
                  rows.add(numbers(couplings[end].master),
                           0.5 * couplings[end].shared_factor(groups[g]));
            rows.end_row();
          }
      }
  }



  template class VertexInterpolation<2>;
  template class VertexInterpolation<3>;
} // namespace Catena

#include <catena/flow/flow_sparsity.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  unsigned int
  n_global_unknowns(const MovingMesh<dim> &mesh, const RigidBodies<dim> &bodies)
  {
    return bodies.n_unknowns() + (mesh.scene().pressure_driven() ? 1 : 0);
  }



  template <int dim>
  FlowSparsity::FlowSparsity(const MovingMesh<dim>                &mesh,
                             const RigidBodies<dim>               &bodies,
                             const std::vector<NodeCoupling<dim>> &couplings)
    : nodes(mesh.n_global_nodes(), mesh.n_global_nodes(), mesh.relevant_nodes())
    , gradients(mesh.n_global_nodes(),
                mesh.scalar_dofs().n_dofs(),
                mesh.relevant_nodes())
    , divergences(mesh.scalar_dofs().n_dofs(),
                  mesh.n_global_nodes(),
                  mesh.relevant_scalars())
    , masses(mesh.scalar_dofs().n_dofs(),
             mesh.scalar_dofs().n_dofs(),
             mesh.relevant_scalars())
    , velocity_motions(mesh.vector_dofs().n_dofs(),
                       n_global_unknowns(mesh, bodies),
                       mesh.relevant_vectors())
    , pressure_motions(mesh.scalar_dofs().n_dofs(),
                       n_global_unknowns(mesh, bodies),
                       mesh.relevant_scalars())
  {
    for (const auto vertex : mesh.owned_scalars())
      masses.add(vertex, vertex);

    std::vector<types::global_dof_index> masters, vertices;
    for (const auto &cell : mesh.cells())
      {
        masters.clear();
        vertices.clear();
        std::vector<unsigned int> motions;
        for (const unsigned int node : cell.nodes)
          {
            if (couplings[node].rigid)
              {
                const auto range = bodies.range(mesh.particle(node));
                for (unsigned int k = range.first; k < range.second; ++k)
                  motions.push_back(k);
              }
            if (couplings[node].has_unknown())
              masters.push_back(couplings[node].master);
          }
        std::sort(masters.begin(), masters.end());
        masters.erase(std::unique(masters.begin(), masters.end()),
                      masters.end());
        for (const unsigned int vertex : cell.vertices)
          vertices.push_back(mesh.vertex_master(vertex));
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()),
                       vertices.end());

        for (const auto master : masters)
          {
            nodes.add_entries(master, masters.begin(), masters.end(), true);
            gradients.add_entries(master,
                                  vertices.begin(),
                                  vertices.end(),
                                  true);
            for (unsigned int row = dim * master; row < dim * (master + 1);
                 ++row)
              {
                for (const unsigned int k : motions)
                  velocity_motions.add(row, k);
                if (mesh.scene().pressure_driven())
                  velocity_motions.add(row, bodies.n_unknowns());
              }
          }
        for (const auto vertex : vertices)
          {
            divergences.add_entries(vertex,
                                    masters.begin(),
                                    masters.end(),
                                    true);
            masses.add_entries(vertex, vertices.begin(), vertices.end(), true);
            for (const unsigned int k : motions)
              pressure_motions.add(vertex, k);
          }
      }

    for (const auto node : mesh.owned_nodes())
      nodes.add(node, node);
  }



  template unsigned int
  n_global_unknowns(const MovingMesh<2> &, const RigidBodies<2> &);
  template unsigned int
  n_global_unknowns(const MovingMesh<3> &, const RigidBodies<3> &);
  template FlowSparsity::FlowSparsity(const MovingMesh<2> &,
                                      const RigidBodies<2> &,
                                      const std::vector<NodeCoupling<2>> &);
  template FlowSparsity::FlowSparsity(const MovingMesh<3> &,
                                      const RigidBodies<3> &,
                                      const std::vector<NodeCoupling<3>> &);
} // namespace Catena

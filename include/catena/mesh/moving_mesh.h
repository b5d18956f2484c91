#ifndef catena_mesh_moving_mesh_h
#define catena_mesh_moving_mesh_h

#include <catena/base/types.h>
#include <catena/mesh/mesh_description.h>
#include <catena/mesh/node_identification.h>
#include <catena/scene/scene.h>

#include <deal.II/base/index_set.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <memory>
#include <vector>

namespace Catena
{
  /**
   * A mesh of quadratic simplices whose nodes move, with the two spaces that
   * live on it: vectors of P2 (velocity, node positions) and scalars of P1
   * (pressure, each component of the log-conformation).
   *
   * Nodes are numbered once: component d of the vector at P2 node i is degree
   * of freedom dim*i + d. Cells with an edge on a particle are curved, their
   * mid-nodes lie on the sphere; all others have straight edges.
   */
  template <int dim>
  class MovingMesh
  {
  public:
    static constexpr unsigned int n_nodes    = n_quadratic_nodes(dim);
    static constexpr unsigned int n_vertices = n_linear_nodes(dim);

    /**
     * A cell this rank works on: one it owns, or one with a node whose
     * equations it owns.
     */
    struct Cell
    {
      typename dealii::Triangulation<dim>::active_cell_iterator iterator;

      /// P2 nodes in the order of FE_SimplexP(2): vertices, then edges
      std::array<unsigned int, n_nodes> nodes;
      /// degrees of freedom of P1 at the vertices
      std::array<unsigned int, n_vertices> vertices;
      bool                                 curved;
      bool                                 owned;
      /// its place in cells()
      unsigned int index;
    };

    /// No particle has this node on its surface.
    static constexpr unsigned int no_particle =
      dealii::numbers::invalid_unsigned_int;

    /**
     * @param scene the scene as it is meshed, the reference of all motion
     * @param description its mesh, the same on every rank
     * @throws MeshError if faces are on surfaces that the scene does not have,
     * or nodes on identified planes have no counterpart
     */
    MovingMesh(const MPI_Comm              communicator,
               const Scene<dim>           &scene,
               const MeshDescription<dim> &description);

    const Scene<dim> &
    scene() const
    {
      return reference_scene;
    }

    /// The vertices, cells and boundary faces this mesh was made of.
    MeshDescription<dim>
    description() const;

    MPI_Comm
    communicator() const
    {
      return triangulation.get_communicator();
    }

    const std::vector<Cell> &
    cells() const
    {
      return local_cells;
    }

    unsigned int
    n_global_cells() const
    {
      return triangulation.n_global_active_cells();
    }

    unsigned int
    n_global_nodes() const
    {
      return node_boundaries.size();
    }

    const dealii::DoFHandler<dim> &
    vector_dofs() const
    {
      return vectors;
    }

    const dealii::DoFHandler<dim> &
    scalar_dofs() const
    {
      return scalars;
    }

    /// P2 nodes owned by this rank.
    const dealii::IndexSet &
    owned_nodes() const
    {
      return nodes_owned;
    }

    /// P2 nodes that its cells refer to, and those they are identified with.
    const dealii::IndexSet &
    relevant_nodes() const
    {
      return nodes_relevant;
    }

    const dealii::IndexSet &
    owned_vectors() const
    {
      return vectors.locally_owned_dofs();
    }

    const dealii::IndexSet &
    relevant_vectors() const
    {
      return vectors_relevant;
    }

    const dealii::IndexSet &
    owned_scalars() const
    {
      return scalars.locally_owned_dofs();
    }

    const dealii::IndexSet &
    relevant_scalars() const
    {
      return scalars_relevant;
    }

    /// A vector field with ghost values, zero.
    VectorType
    vector_field() const
    {
      return zero_field(owned_vectors(), vectors_relevant);
    }

    /// A scalar field with ghost values, zero.
    VectorType
    scalar_field() const
    {
      return zero_field(owned_scalars(), scalars_relevant);
    }

    /// Components of a symmetric tensor field with ghost values, zero.
    std::vector<VectorType>
    tensor_field() const;

    bool
    on_boundary(const unsigned int               node,
                const dealii::types::boundary_id id) const
    {
      return (node_boundaries[node] >> id) & 1u;
    }

    /// Does the node lie on a wall, y = -H/2 or H/2?
    bool
    on_wall(const unsigned int node) const;

    /// Does the node lie on a mirror plane?
    bool
    on_mirror(const unsigned int node) const
    {
      return on_boundary(node, BoundaryIds::z_low) ||
             on_boundary(node, BoundaryIds::z_high);
    }

    /// The particle on whose surface the node lies, or no_particle.
    unsigned int
    particle(const unsigned int node) const
    {
      return node_surfaces[node] == no_particle ?
               no_particle :
               surfaces[node_surfaces[node]].particle;
    }

    /// The image of its particle on which a node of a particle lies.
    const Image<dim> &
    particle_image(const unsigned int node) const
    {
      return surfaces[node_surfaces[node]].image;
    }

    /**
     * Vector from the centre of its particle to a node of a particle at @p x,
     * as it is on the particle itself: turned back if the node is on a turned
     * image.
     */
    dealii::Tensor<1, dim>
    arm(const unsigned int                     node,
        const dealii::Point<dim>              &x,
        const std::vector<dealii::Point<dim>> &centres) const
    {
      return particle_image(node).origin(x) - centres[particle(node)];
    }

    const NodeIdentification &
    identification() const
    {
      return *node_identification;
    }

    /// The P2 node at the vertex of a degree of freedom of P1.
    unsigned int
    node_of_vertex(const unsigned int scalar_dof) const
    {
      return vertex_nodes[scalar_dof];
    }

    /// The degree of freedom of P1 at a P2 node at a vertex.
    unsigned int
    vertex_of_node(const unsigned int node) const
    {
      return node_vertices[node];
    }

    /// The degree of freedom of P1 that stands for an identified one.
    unsigned int
    vertex_master(const unsigned int scalar_dof) const
    {
      return vertex_of_node(
        identification().master(node_of_vertex(scalar_dof)));
    }

    /// The end nodes of the edge of a P2 node; the node itself at a vertex.
    const std::array<unsigned int, 2> &
    edge_ends(const unsigned int node) const
    {
      return node_ends[node];
    }

    bool
    is_vertex(const unsigned int node) const
    {
      return node_ends[node][0] == node_ends[node][1];
    }

    /**
     * All P2 nodes in the order in which the cells of the description meet
     * them: an order that does not depend on the number of ranks.
     */
    const std::vector<unsigned int> &
    node_order() const
    {
      return ordered_nodes;
    }

    /// Node positions as meshed.
    const VectorType &
    reference_positions() const
    {
      return reference;
    }

    /// Node positions now; the mapping follows them.
    const VectorType &
    positions() const
    {
      return current;
    }

    /// Move the nodes to @p positions, and the mapping with them.
    void
    set_positions(const VectorType &positions);

    const dealii::Mapping<dim> &
    mapping() const
    {
      return *quadratic_mapping;
    }

    /// Positions of the P2 nodes of a cell.
    std::array<dealii::Point<dim>, n_nodes>
    cell_positions(const Cell &cell, const VectorType &positions) const;

    /**
     * Smallest quality (radius ratio) of the cells, with the sign of the
     * smallest Jacobian at the nodes: positive for a valid mesh.
     */
    double
    quality() const;

  private:
    Scene<dim>                                   reference_scene;
    dealii::parallel::shared::Triangulation<dim> triangulation;
    dealii::FESystem<dim>                        vector_element;
    dealii::FE_SimplexP<dim>                     scalar_element;
    dealii::DoFHandler<dim>                      vectors;
    dealii::DoFHandler<dim>                      scalars;

    std::vector<Cell>          local_cells;
    std::vector<std::uint32_t> node_boundaries;
    std::vector<Surface<dim>>  surfaces;
    std::vector<unsigned int>  node_surfaces;
    std::vector<unsigned int>  vertex_nodes;
    std::vector<unsigned int>  node_vertices;
    std::vector<unsigned int>  ordered_nodes;

    std::vector<std::array<unsigned int, 2>> node_ends;
    std::unique_ptr<NodeIdentification>      node_identification;

    dealii::IndexSet nodes_owned, nodes_relevant;
    dealii::IndexSet vectors_relevant, scalars_relevant;

    VectorType                            reference, current;
    std::unique_ptr<dealii::Mapping<dim>> quadratic_mapping;

    Cell
    describe_cell(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const;

    std::vector<dealii::Point<dim>>
    classify_nodes(const std::vector<Cell> &all_cells);

    void
    select_cells(const std::vector<Cell> &all_cells);

    VectorType
    zero_field(const dealii::IndexSet &owned,
               const dealii::IndexSet &relevant) const;
  };
} // namespace Catena

#endif

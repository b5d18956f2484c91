#include <catena/base/exceptions.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/mesh/quadratic_shape.h>
#include <catena/mesh/quality.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/mapping_fe_field.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  MovingMesh<dim>::MovingMesh(const MPI_Comm              communicator,
                              const Scene<dim>           &scene,
                              const MeshDescription<dim> &description)
    : reference_scene(scene)
    , triangulation(communicator,
                    Triangulation<dim>::none,
                    false,
                    parallel::shared::Triangulation<dim>::partition_metis)
    , vector_element(FE_SimplexP<dim>(2), dim)
    , scalar_element(1)
    , vectors(triangulation)
    , scalars(triangulation)
    , surfaces(scene.surfaces())
  {
    triangulation.create_triangulation(description.vertices,
                                       description.cells,
                                       description.boundary);
    vectors.distribute_dofs(vector_element);
    scalars.distribute_dofs(scalar_element);

    std::vector<Cell> all_cells;
    all_cells.reserve(triangulation.n_active_cells());
    for (const auto &cell : vectors.active_cell_iterators())
      all_cells.push_back(describe_cell(cell));

    const std::vector<Point<dim>> points = classify_nodes(all_cells);
    node_identification = std::make_unique<NodeIdentification>(reference_scene,
                                                               points,
                                                               node_boundaries);
    select_cells(all_cells);

    reference = vector_field();
    for (const unsigned int node : nodes_owned)
      for (unsigned int d = 0; d < dim; ++d)
        reference(dim * node + d) = points[node][d];
    reference.update_ghost_values();
    current = reference;
    current.update_ghost_values();
    quadratic_mapping =
      std::make_unique<MappingFEField<dim, dim, VectorType>>(vectors, current);
  }



  template <int dim>
  typename MovingMesh<dim>::Cell
  MovingMesh<dim>::describe_cell(
    const typename DoFHandler<dim>::active_cell_iterator &cell) const
  {
    Cell result;
    result.iterator = cell;
    result.curved   = false;
    result.owned    = cell->is_locally_owned();
    result.index    = numbers::invalid_unsigned_int;

    std::vector<types::global_dof_index> dofs(vector_element.n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const auto component = vector_element.system_to_component_index(i);
        if (component.first == 0)
          result.nodes[component.second] = dofs[i] / dim;
        AssertThrow(dofs[i] ==
                      dim * result.nodes[component.second] + component.first,
                    ExcInternalError());
      }

    const typename DoFHandler<dim>::active_cell_iterator scalar_cell(
      &triangulation, cell->level(), cell->index(), &scalars);
    std::vector<types::global_dof_index> scalar_indices(n_vertices);
    scalar_cell->get_dof_indices(scalar_indices);
    std::copy(scalar_indices.begin(),
              scalar_indices.end(),
              result.vertices.begin());
    return result;
  }



  /**
   * Boundaries, particle, edge and position of every node. Every rank knows
   * the whole mesh while it is set up.
   */
  template <int dim>
  std::vector<Point<dim>>
  MovingMesh<dim>::classify_nodes(const std::vector<Cell> &all_cells)
  {
    const unsigned int      n = vectors.n_dofs() / dim;
    std::vector<Point<dim>> points(n);
    node_boundaries.assign(n, 0);
    node_surfaces.assign(n, no_particle);
    node_vertices.assign(n, numbers::invalid_unsigned_int);
    vertex_nodes.resize(scalars.n_dofs());
    node_ends.resize(n);

    std::vector<bool> is_ordered(n, false);
    for (const Cell &cell : all_cells)
      {
        for (const unsigned int node : cell.nodes)
          if (!is_ordered[node])
            {
              is_ordered[node] = true;
              ordered_nodes.push_back(node);
            }
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            points[cell.nodes[v]]          = cell.iterator->vertex(v);
            vertex_nodes[cell.vertices[v]] = cell.nodes[v];
            node_vertices[cell.nodes[v]]   = cell.vertices[v];
            node_ends[cell.nodes[v]]       = {{cell.nodes[v], cell.nodes[v]}};
          }
        for (unsigned int e = n_vertices; e < n_nodes; ++e)
          {
            const auto v             = simplex_edge(e - n_vertices);
            node_ends[cell.nodes[e]] = {{cell.nodes[v[0]], cell.nodes[v[1]]}};
            points[cell.nodes[e]] =
              (cell.iterator->vertex(v[0]) + cell.iterator->vertex(v[1])) / 2.;
          }

        for (const unsigned int f : cell.iterator->face_indices())
          if (cell.iterator->face(f)->at_boundary())
            {
              const auto                   face = cell.iterator->face(f);
              const types::boundary_id     id   = face->boundary_id();
              std::array<bool, n_vertices> in_face{};
              for (unsigned int v = 0; v < n_vertices; ++v)
                for (unsigned int k = 0; k < dim; ++k)
                  in_face[v] |=
                    face->vertex_index(k) == cell.iterator->vertex_index(v);
              for (unsigned int i = 0; i < n_nodes; ++i)
                {
                  const auto ends   = i < n_vertices ?
                                        std::array<unsigned int, 2>{{i, i}} :
                                        simplex_edge(i - n_vertices);
                  const bool inside = in_face[ends[0]] && in_face[ends[1]];
                  if (inside && id >= BoundaryIds::particle)
                    {
                      const unsigned int surface = id - BoundaryIds::particle;
                      if (surface >= surfaces.size())
                        throw MeshError("A face of the mesh is on surface " +
                                        std::to_string(surface) + " of " +
                                        std::to_string(surfaces.size()) + ".");
                      node_surfaces[cell.nodes[i]] = surface;
                    }
                  else if (inside)
                    node_boundaries[cell.nodes[i]] |= 1u << id;
                }
            }
      }

    for (unsigned int i = 0; i < n; ++i)
      if (node_surfaces[i] != no_particle && node_ends[i][0] != i)
        points[i] = surfaces[node_surfaces[i]].nearest(points[i]);
    return points;
  }



  template <int dim>
  void
  MovingMesh<dim>::select_cells(const std::vector<Cell> &all_cells)
  {
    const IndexSet &owned_vector_dofs = vectors.locally_owned_dofs();
    nodes_owned.set_size(n_global_nodes());
    nodes_relevant.set_size(n_global_nodes());
    for (unsigned int i = 0; i < n_global_nodes(); ++i)
      if (owned_vector_dofs.is_element(dim * i))
        nodes_owned.add_index(i);

    const IndexSet   &owned_scalar_dofs = scalars.locally_owned_dofs();
    std::vector<char> relevant(n_global_nodes(), 0);
    for (Cell cell : all_cells)
      {
        bool mine = cell.owned;
        for (const unsigned int node : cell.nodes)
          mine |= nodes_owned.is_element(node_identification->master(node)) ||
                  nodes_owned.is_element(node);
        for (const unsigned int vertex : cell.vertices)
          mine |=
            owned_scalar_dofs.is_element(vertex) ||
            owned_scalar_dofs.is_element(
              node_vertices[node_identification->master(vertex_nodes[vertex])]);
        if (!mine)
          continue;
        for (unsigned int e = n_vertices; e < n_nodes; ++e)
          cell.curved |= node_surfaces[cell.nodes[e]] != no_particle;
        for (const unsigned int node : cell.nodes)
          relevant[node] = relevant[node_identification->master(node)] = 1;
        cell.index = local_cells.size();
        local_cells.push_back(cell);
      }

    vectors_relevant.set_size(vectors.n_dofs());
    scalars_relevant.set_size(scalars.n_dofs());
    std::vector<types::global_dof_index> scalar_indices;
    for (unsigned int i = 0; i < n_global_nodes(); ++i)
      if (relevant[i] || nodes_owned.is_element(i))
        {
          nodes_relevant.add_index(i);
          vectors_relevant.add_range(dim * i, dim * i + dim);
          if (node_vertices[i] != numbers::invalid_unsigned_int)
            scalar_indices.push_back(node_vertices[i]);
        }
    std::sort(scalar_indices.begin(), scalar_indices.end());
    scalars_relevant.add_indices(scalar_indices.begin(), scalar_indices.end());
    scalars_relevant.add_indices(owned_scalar_dofs);
    nodes_relevant.compress();
    vectors_relevant.compress();
    scalars_relevant.compress();
  }



  template <int dim>
  MeshDescription<dim>
  MovingMesh<dim>::description() const
  {
    MeshDescription<dim> result;
    result.vertices = triangulation.get_vertices();
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        result.cells.emplace_back(n_vertices);
        for (unsigned int v = 0; v < n_vertices; ++v)
          result.cells.back().vertices[v] = cell->vertex_index(v);
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary())
              continue;
            CellData<dim - 1> data(dim);
            data.boundary_id = face->boundary_id();
            for (unsigned int v = 0; v < dim; ++v)
              data.vertices[v] = face->vertex_index(v);
            boundary_faces(result).push_back(data);
          }
      }
    return result;
  }



  template <int dim>
  bool
  MovingMesh<dim>::on_wall(const unsigned int node) const
  {
    const bool low_is_wall =
      !(reference_scene.rotational() && reference_scene.cut == Cut::y_plane);
    return on_boundary(node, BoundaryIds::y_high) ||
           (low_is_wall && on_boundary(node, BoundaryIds::y_low));
  }



  template <int dim>
  void
  MovingMesh<dim>::set_positions(const VectorType &positions)
  {
    current = positions;
    current.update_ghost_values();
  }



  template <int dim>
  std::array<Point<dim>, MovingMesh<dim>::n_nodes>
  MovingMesh<dim>::cell_positions(const Cell       &cell,
                                  const VectorType &positions) const
  {
    std::array<Point<dim>, n_nodes> points;
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        points[i][d] = positions(dim * cell.nodes[i] + d);
    return points;
  }



  template <int dim>
  double
  MovingMesh<dim>::quality() const
  {
    double smallest = 1.;
    for (const Cell &cell : local_cells)
      {
        const auto points = cell_positions(cell, current);
        std::array<Point<dim>, n_vertices> vertices;
        std::copy_n(points.begin(), n_vertices, vertices.begin());
        smallest =
          std::min(smallest,
                   cell.curved ? quadratic_simplex_quality<dim>(points) :
                                 simplex_quality<dim>(vertices));
      }
    return Utilities::MPI::min(smallest, communicator());
  }



  template <int dim>
  VectorType
  MovingMesh<dim>::zero_field(const IndexSet &owned,
                              const IndexSet &relevant) const
  {
    VectorType field(owned, relevant, communicator());
    // ghosts of zeros need no message
    field.set_ghost_state(true);
    return field;
  }



  template <int dim>
  std::vector<VectorType>
  MovingMesh<dim>::tensor_field() const
  {
    // sized first: a vector copied when the list grows loses its ghost values
    std::vector<VectorType> components(n_symmetric_components(dim));
    for (VectorType &component : components)
      component = scalar_field();
    return components;
  }



  template class MovingMesh<2>;
  template class MovingMesh<3>;
} // namespace Catena

#include <catena/flow/flow_matrices.h>
#include <catena/flow/flow_sparsity.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FlowMatrices<dim>::FlowMatrices(
    const MovingMesh<dim>                &mesh,
    const RigidBodies<dim>               &bodies,
    const std::vector<NodeCoupling<dim>> &couplings)
    : rigid_rigid(n_global_unknowns(mesh, bodies))
    , velocity_rhs(mesh.owned_vectors(), mesh.communicator())
    , pressure_rhs(mesh.owned_scalars(), mesh.communicator())
    , rigid_rhs(n_rigid())
    , vertex_volumes(mesh.owned_scalars(), mesh.communicator())
    , mesh(mesh)
    , bodies(bodies)
    , rigid_owned(n_rigid())
    , rigid_relevant(n_rigid())
  {
    rigid_relevant.add_range(0, n_rigid());
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      rigid_owned.add_range(0, n_rigid());
    make_patterns(couplings);
  }



  template <int dim>
  void
  FlowMatrices<dim>::make_patterns(
    const std::vector<NodeCoupling<dim>> &couplings)
  {
    const FlowSparsity sparsity(mesh, bodies, couplings);
    const MPI_Comm     comm     = mesh.communicator();
    const IndexSet    &nodes    = mesh.owned_nodes();
    const IndexSet    &vertices = mesh.owned_scalars();
    const auto         pattern  = [&](const IndexSet               &rows,
                             const IndexSet               &columns,
                             const DynamicSparsityPattern &pairs) {
      return std::make_shared<const BlockPattern>(rows, columns, pairs, comm);
    };
    velocity =
      BlockMatrix<dim, dim, double>(pattern(nodes, nodes, sparsity.nodes));
    gradient =
      BlockMatrix<dim, 1, double>(pattern(nodes, vertices, sparsity.gradients));
    divergence = BlockMatrix<1, dim, double>(
      pattern(vertices, nodes, sparsity.divergences));
    pressure_mass.reinit(mesh.owned_scalars(),
                         mesh.owned_scalars(),
                         sparsity.masses,
                         comm);
    mass_access =
      CsrAccess(pressure_mass, mesh.owned_scalars(), mesh.relevant_scalars());
    if (n_rigid() > 0)
      {
        velocity_rigid.reinit(mesh.owned_vectors(),
                              rigid_owned,
                              sparsity.velocity_motions,
                              comm);
        velocity_rigid_access =
          CsrAccess(velocity_rigid, mesh.owned_vectors(), rigid_relevant);
        rigid_velocity_transposed.reinit(mesh.owned_vectors(),
                                         rigid_owned,
                                         sparsity.velocity_motions,
                                         comm);
        rigid_velocity_access = CsrAccess(rigid_velocity_transposed,
                                          mesh.owned_vectors(),
                                          rigid_relevant);
        pressure_rigid.reinit(mesh.owned_scalars(),
                              rigid_owned,
                              sparsity.pressure_motions,
                              comm);
        pressure_rigid_access =
          CsrAccess(pressure_rigid, mesh.owned_scalars(), rigid_relevant);
        velocity_rigid_product = RigidProduct(velocity_rigid);
        rigid_velocity_product = RigidProduct(rigid_velocity_transposed);
        pressure_rigid_product = RigidProduct(pressure_rigid);
      }
    make_component_matrices(couplings);
    find_offsets(couplings);
  }



  template <int dim>
  void
  FlowMatrices<dim>::find_offsets(
    const std::vector<NodeCoupling<dim>> &couplings)
  {
    offsets.assign(mesh.cells().size(), Offsets());
    for (unsigned int c = 0; c < offsets.size(); ++c)
      {
        const auto &cell = mesh.cells()[c];
        for (unsigned int b = 0; b < Offsets::n_nodes; ++b)
          {
            const NodeCoupling<dim> &trial = couplings[cell.nodes[b]];
            if (!trial.has_unknown())
              continue;
            for (unsigned int a = 0; a < Offsets::n_nodes; ++a)
              {
                const NodeCoupling<dim> &test = couplings[cell.nodes[a]];
                const unsigned int row = velocity.pattern().row(test.master);
                if (test.has_unknown() && row != BlockPattern::absent)
                  offsets[c].velocity[a][b] =
                    velocity.pattern().offset(row, trial.master);
              }
            const unsigned int gradient_row =
              gradient.pattern().row(trial.master);
            for (unsigned int v = 0; v < Offsets::n_vertices; ++v)
              {
                const unsigned int vertex =
                  mesh.vertex_master(cell.vertices[v]);
                const unsigned int row = divergence.pattern().row(vertex);
                if (row != BlockPattern::absent)
                  offsets[c].divergence[v][b] =
                    divergence.pattern().offset(row, trial.master);
                if (gradient_row != BlockPattern::absent)
                  offsets[c].gradient[v][b] =
                    gradient.pattern().offset(gradient_row, vertex);
              }
          }
      }
  }



  /// Has a component the factors of others wherever both have an unknown?
  template <int dim>
  bool
  FlowMatrices<dim>::share_operator(
    const std::vector<unsigned int>      &components,
    const unsigned int                    component,
    const std::vector<NodeCoupling<dim>> &couplings) const
  {
    bool equal = true;
    for (const auto node : mesh.relevant_nodes())
      for (const unsigned int d : components)
        {
          const double product =
            couplings[node].factors[d] * couplings[node].factors[component];
          equal &= product >= 0.;
        }
    return Utilities::MPI::min(equal ? 1 : 0, mesh.communicator()) == 1;
  }



  template <int dim>
  void
  FlowMatrices<dim>::make_component_matrices(
    const std::vector<NodeCoupling<dim>> &couplings)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        bool is_new = true;
        for (ComponentMatrix &group : component_matrices)
          if (is_new && share_operator(group.components, d, couplings))
            {
              group.components.push_back(d);
              is_new = false;
            }
        if (is_new)
          component_matrices.push_back(
            {{d}, BlockMatrix<1, 1, double>(velocity.shared_pattern())});
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::clear(const bool with_preconditioner)
  {
    velocity.clear();
    gradient.clear();
    divergence.clear();
    if (n_rigid() > 0)
      {
        velocity_rigid            = 0.;
        rigid_velocity_transposed = 0.;
        pressure_rigid            = 0.;
      }
    rigid_rigid    = 0.;
    velocity_rhs   = 0.;
    pressure_rhs   = 0.;
    vertex_volumes = 0.;
    std::fill(rigid_rhs.begin(), rigid_rhs.end(), 0.);
    if (with_preconditioner)
      {
        pressure_mass = 0.;
        for (ComponentMatrix &component : component_matrices)
          component.matrix.clear();
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::update_single_precision()
  {
    fast_velocity   = velocity;
    fast_gradient   = gradient;
    fast_divergence = divergence;
  }



  template class FlowMatrices<2>;
  template class FlowMatrices<3>;
} // namespace Catena

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
    const MPI_Comm     comm = mesh.communicator();
    velocity.reinit(mesh.owned_vectors(),
                    mesh.owned_vectors(),
                    sparsity.velocities,
                    comm);
    velocity_access =
      CsrAccess(velocity, mesh.owned_vectors(), mesh.relevant_vectors());
    gradient.reinit(mesh.owned_vectors(),
                    mesh.owned_scalars(),
                    sparsity.gradients,
                    comm);
    gradient_access =
      CsrAccess(gradient, mesh.owned_vectors(), mesh.relevant_scalars());
    divergence.reinit(mesh.owned_scalars(),
                      mesh.owned_vectors(),
                      sparsity.divergences,
                      comm);
    divergence_access =
      CsrAccess(divergence, mesh.owned_scalars(), mesh.relevant_vectors());
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
    velocity_product   = BlockProduct<dim, dim>(velocity);
    gradient_product   = BlockProduct<dim, 1>(gradient);
    divergence_product = BlockProduct<1, dim>(divergence);
    make_component_matrices(couplings, sparsity.nodes);
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
                const int row = velocity_access.row(dim * test.master);
                if (test.has_unknown() && row != CsrAccess::absent)
                  offsets[c].velocity[a][b] = velocity_access.offset(
                    row, velocity_access.column(dim * trial.master));
              }
            const int gradient_row = gradient_access.row(dim * trial.master);
            for (unsigned int v = 0; v < Offsets::n_vertices; ++v)
              {
                const unsigned int vertex =
                  mesh.vertex_master(cell.vertices[v]);
                const int row = divergence_access.row(vertex);
                if (row != CsrAccess::absent)
                  offsets[c].divergence[v][b] = divergence_access.offset(
                    row, divergence_access.column(dim * trial.master));
                if (gradient_row != CsrAccess::absent)
                  offsets[c].gradient[v][b] =
                    gradient_access.offset(gradient_row,
                                           gradient_access.column(vertex));
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
    const std::vector<NodeCoupling<dim>> &couplings,
    const DynamicSparsityPattern         &nodes)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        bool is_new = true;
        for (const auto &group : component_matrices)
          if (is_new && share_operator(group->components, d, couplings))
            {
              group->components.push_back(d);
              is_new = false;
            }
        if (!is_new)
          continue;
        auto group = std::make_unique<ComponentMatrix>();
        group->components.push_back(d);
        group->matrix.reinit(mesh.owned_nodes(),
                             mesh.owned_nodes(),
                             nodes,
                             mesh.communicator());
        group->access =
          CsrAccess(group->matrix, mesh.owned_nodes(), mesh.relevant_nodes());
        component_matrices.push_back(std::move(group));
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::clear(const bool with_preconditioner)
  {
    velocity   = 0.;
    gradient   = 0.;
    divergence = 0.;
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
        for (const auto &component : component_matrices)
          component->matrix = 0.;
      }
  }



  template <int dim>
  void
  FlowMatrices<dim>::update_products()
  {
    velocity_product.update();
    gradient_product.update();
    divergence_product.update();
  }



  template class FlowMatrices<2>;
  template class FlowMatrices<3>;
} // namespace Catena

#include <catena/base/replicated.h>
#include <catena/flow/flow_unknowns.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/mesh/cell_fields.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// That of the imposed flow at a node.
    template <int dim>
    Tensor<1, dim>
    imposed_velocity(const FlowUnknowns<dim> &unknowns, const unsigned int node)
    {
      return unknowns.configuration.shear_rate *
             unknowns.mesh.scene().imposed_velocity(
               node_position<dim>(unknowns.mesh.positions(), node));
    }
  } // namespace



  template <int dim>
  BlockVectorType
  FlowUnknowns<dim>::make_vector(const unsigned int n_contacts) const
  {
    const MPI_Comm comm    = mesh.communicator();
    const unsigned n_rigid = system.n_rigid();
    const auto     on_root = [&](const unsigned int n) {
      IndexSet set(n);
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        set.add_range(0, n);
      return VectorType(set, comm);
    };
    BlockVectorType vector(n_rigid == 0 ? 2 : (n_contacts == 0 ? 3 : 4));
    vector.block(0).reinit(system.velocity_rhs);
    vector.block(1).reinit(system.pressure_rhs);
    if (n_rigid > 0)
      vector.block(2).reinit(on_root(n_rigid));
    if (n_contacts > 0)
      vector.block(3).reinit(on_root(n_contacts));
    vector.collect_sizes();
    return vector;
  }



  template <int dim>
  ContactBlocks
  FlowUnknowns<dim>::contact_blocks(
    const std::vector<Contact<dim>> &contacts) const
  {
    const unsigned int        n = bodies.n_unknowns(), m = contacts.size();
    const std::vector<double> reference =
      bodies.values(reference_motions<dim>(mesh.scene(), configuration, held));

    ContactBlocks blocks;
    if (m > 0)
      blocks.rates.reinit(m, system.n_rigid());
    blocks.given.assign(m, 0.);
    for (unsigned int c = 0; c < m; ++c)
      {
        const std::vector<double> rate = contacts[c].rate(bodies);
        for (unsigned int k = 0; k < n; ++k)
          {
            blocks.rates(c, k) = rate[k];
            blocks.given[c] -= rate[k] * reference[k];
          }
        blocks.shares.push_back(contacts[c].meshed_share);
      }
    return blocks;
  }



  template <int dim>
  BlockVectorType
  FlowUnknowns<dim>::right_hand_side(
    const ContactBlocks       &contacts,
    const std::vector<double> &external_forces) const
  {
    BlockVectorType rhs = make_vector(contacts.n_contacts());
    rhs.block(0)        = system.velocity_rhs;
    rhs.block(1)        = system.pressure_rhs;
    // the flux through the boundary vanishes up to rounding
    rhs.block(1).add(-rhs.block(1).mean_value());
    if (system.n_rigid() > 0)
      {
        std::vector<double> forces = system.rigid_rhs;
        for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
          if (bodies.is_free(k))
            forces[k] += bodies.meshed_share(k) * external_forces[k];
        set_replicated(rhs.block(2), forces);
      }
    if (contacts.n_contacts() > 0)
      set_replicated(rhs.block(3), contacts.given);
    return rhs;
  }



  template <int dim>
  BlockVectorType
  FlowUnknowns<dim>::first_guess(const FlowFields<dim>     &fields,
                                 const std::vector<double> &forces) const
  {
    BlockVectorType guess = make_vector(forces.size());
    for (const auto node : mesh.owned_nodes())
      {
        const Tensor<1, dim> imposed = imposed_velocity(*this, node);
        for (unsigned int d = 0; d < dim; ++d)
          if (couplings[node].is_unknown(node, d))
            guess.block(0)(dim * node + d) =
              fields.velocity(dim * node + d) - imposed[d];
      }
    for (const auto vertex : mesh.owned_scalars())
      if (mesh.vertex_master(vertex) == vertex)
        guess.block(1)(vertex) = fields.pressure(vertex);
    if (system.n_rigid() > 0)
      set_replicated(guess.block(2), global_unknowns(fields));
    if (forces.size() > 0)
      set_replicated(guess.block(3), forces);
    return guess;
  }



  template <int dim>
  std::vector<double>
  FlowUnknowns<dim>::global_unknowns(const FlowFields<dim> &fields) const
  {
    std::vector<double>       values = bodies.values(fields.motions);
    const std::vector<double> reference =
      bodies.values(reference_motions<dim>(mesh.scene(), configuration, held));
    for (unsigned int k = 0; k < values.size(); ++k)
      values[k] = bodies.is_free(k) ? values[k] - reference[k] : 0.;
    if (mesh.scene().pressure_driven())
      values.push_back(fields.pressure_drop);
    return values;
  }



  template <int dim>
  void
  FlowUnknowns<dim>::normalise_pressure(VectorType &pressure) const
  {
    const VectorType &volumes = system.vertex_volumes;
    const double      mean =
      (pressure * volumes) / (volumes.mean_value() * volumes.size());
    for (const auto i : volumes.locally_owned_elements())
      pressure(i) = volumes(i) != 0. ? pressure(i) - mean : 0.;
  }



  template <int dim>
  void
  FlowUnknowns<dim>::extract_velocity(const BlockVectorType &solution,
                                      FlowFields<dim>       &fields) const
  {
    std::vector<double> motions;
    if (system.n_rigid() > 0)
      motions = replicate(solution.block(2));
    if (mesh.scene().pressure_driven())
      fields.pressure_drop = motions.back();

    VectorType disturbance = mesh.vector_field();
    disturbance.copy_locally_owned_data_from(solution.block(0));
    disturbance.update_ghost_values();
    fields.velocity = mesh.vector_field();
    for (const auto node : mesh.owned_nodes())
      {
        const Tensor<1, dim> imposed  = imposed_velocity(*this, node);
        const auto          &coupling = couplings[node];
        for (unsigned int d = 0; d < dim; ++d)
          {
            double value = imposed[d] + coupling.known[d];
            if (coupling.factors[d] != 0.)
              value +=
                coupling.factors[d] * disturbance(dim * coupling.master + d);
            fields.velocity(dim * node + d) = value;
          }
        for (const NodeMotion &motion : coupling.motions)
          fields.velocity(dim * node + motion.component) +=
            motion.factor * motions[motion.unknown];
      }
    fields.velocity.update_ghost_values();

    const auto references =
      reference_motions<dim>(mesh.scene(), configuration, held);
    fields.motions = bodies.motions(motions);
    for (unsigned int i = 0; i < fields.motions.size(); ++i)
      {
        fields.motions[i].velocity += references[i].velocity;
        fields.motions[i].angular_velocity += references[i].angular_velocity;
      }
  }



  template <int dim>
  void
  FlowUnknowns<dim>::extract(const BlockVectorType   &solution,
                             const std::vector<bool> &set,
                             FlowFields<dim>         &fields) const
  {
    extract_velocity(solution, fields);

    VectorType masters = mesh.scalar_field();
    masters.copy_locally_owned_data_from(solution.block(1));
    masters.update_ghost_values();
    fields.pressure = mesh.scalar_field();
    for (const auto vertex : mesh.owned_scalars())
      fields.pressure(vertex) = masters(mesh.vertex_master(vertex));
    fields.pressure.update_ghost_values();

    std::vector<double> forces;
    if (solution.n_blocks() > 3)
      forces = replicate(solution.block(3));
    fields.contact_forces.assign(set.size(), 0.);
    for (unsigned int c = 0, row = 0; c < set.size(); ++c)
      if (set[c])
        fields.contact_forces[c] = forces[row++];
  }



  template struct FlowUnknowns<2>;
  template struct FlowUnknowns<3>;
} // namespace Catena

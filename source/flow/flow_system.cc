#include <catena/base/node_dofs.h>
#include <catena/flow/flow_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n = n_node_numbers;

    /// Rounding in double precision, with coefficients to 2^-49, against that
    /// in single, 2^-24, with some reserve.
    constexpr double double_to_single = 1e-7;
  } // namespace



  template <int dim>
  FlowSystem<dim>::FlowSystem(const MovingMesh<dim>                &mesh,
                              const RigidBodies<dim>               &bodies,
                              const std::vector<NodeCoupling<dim>> &couplings)
    : mesh(mesh)
    , vertex_volumes(mesh.owned_scalars(), mesh.communicator())
    , velocity_rhs(mesh.owned_vectors(), mesh.communicator())
    , pressure_rhs(mesh.owned_scalars(), mesh.communicator())
    , rigid_rhs(bodies.n_unknowns() + (mesh.scene().pressure_driven() ? 1 : 0))
    , bodies(bodies)
    , couplings(couplings)
    , node_partitioner(mesh.owned_nodes(),
                       nodes_of_owned_cells(),
                       mesh.communicator())
    , layout(std::make_shared<Utilities::MPI::Partitioner>(
        node_dofs(mesh.owned_nodes(), n),
        node_dofs(node_partitioner.ghost_indices(), n),
        mesh.communicator()))
  {
    cells  = FlowCells<dim>(mesh, node_partitioner);
    fields = {node_field(), node_field()};
    fast_fields.given.reinit(layout);
    fast_fields.sums.reinit(layout);

    for (const auto vertex : mesh.owned_scalars())
      {
        vertex_nodes.push_back(
          node_partitioner.global_to_local(mesh.node_of_vertex(vertex)));
        // of the same rank
        AssertThrow(vertex_nodes.back() < mesh.owned_nodes().n_elements(),
                    ExcInternalError());
      }
    const unsigned int n_nodes = node_partitioner.locally_owned_size() +
                                 node_partitioner.n_ghost_indices();
    for (unsigned int local = 0; local < n_nodes; ++local)
      {
        const unsigned int node   = node_partitioner.local_to_global(local);
        const auto         master = mesh.identification().master(node);
        if (mesh.is_vertex(node) && master != node)
          identified_vertices.push_back(
            {local, node_partitioner.global_to_local(master)});
      }
  }



  template <int dim>
  void
  FlowSystem<dim>::collect_coupled_nodes()
  {
    coupled_nodes.clear();
    node_motions.clear();
    has_coupled_nodes          = true;
    const unsigned int n_nodes = node_partitioner.locally_owned_size() +
                                 node_partitioner.n_ghost_indices();
    const auto is_one = [](const double factor) { return factor == 1.; };
    for (unsigned int local = 0; local < n_nodes; ++local)
      {
        const unsigned int       node = node_partitioner.local_to_global(local);
        const NodeCoupling<dim> &coupling = couplings[node];
        if (coupling.master == node && std::all_of(coupling.factors.begin(),
                                                   coupling.factors.end(),
                                                   is_one))
          continue;
        node_motions.insert(node_motions.end(),
                            coupling.motions.begin(),
                            coupling.motions.end());
        coupled_nodes.push_back(
          {local,
           node_partitioner.global_to_local(coupling.master),
           coupling.factors,
           static_cast<unsigned int>(node_motions.size())});
      }
  }



  /// With the masters of these nodes.
  template <int dim>
  IndexSet
  FlowSystem<dim>::nodes_of_owned_cells() const
  {
    std::vector<bool> found(mesh.n_global_nodes(), false);
    const auto        add = [&](const types::global_dof_index node) {
      found[node]                               = true;
      found[couplings[node].master]             = true;
      found[mesh.identification().master(node)] = true;
    };
    for (const auto node : mesh.owned_nodes())
      add(node);
    for (const auto &cell : mesh.cells())
      if (cell.owned)
        for (const unsigned int node : cell.nodes)
          add(node);
    IndexSet set(found.size());
    for (unsigned int node = 0; node < found.size(); ++node)
      if (found[node])
        set.add_index(node);
    set.compress();
    return set;
  }



  /**
   * The velocities and pressures of all nodes of this rank's cells.
   */
  template <int dim>
  template <typename Number, typename Vector>
  void
  FlowSystem<dim>::give_nodes(NodeField<Number>      &field,
                              const Unknowns<Vector> &unknowns) const
  {
    const unsigned int n_owned = mesh.owned_nodes().n_elements();
    Number *const      values  = field.begin();
    const auto *const  u       = unknowns.velocity.begin();
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        values[n * i + d] = u[dim * i + d];
    for (unsigned int v = 0; v < vertex_nodes.size(); ++v)
      values[n * vertex_nodes[v] + dim] = unknowns.pressure.local_element(v);
    field.update_ghost_values();

    auto motion = node_motions.begin();
    for (const CoupledNode &node : coupled_nodes)
      {
        std::array<double, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = node.factors[d] * values[n * node.master + d];
        const auto end = node_motions.begin() + node.end_of_motions;
        for (; motion != end; ++motion)
          value[motion->component] +=
            motion->factor * unknowns.motions[motion->unknown];
        for (unsigned int d = 0; d < dim; ++d)
          values[n * node.local + d] = value[d];
      }
    for (const IdentifiedVertex &vertex : identified_vertices)
      values[n * vertex.local + dim] = values[n * vertex.master + dim];
  }



  /**
   * What the sums at the nodes are for the unknowns; the motions get those of
   * this rank.
   */
  template <int dim>
  template <typename Number, typename Vector>
  void
  FlowSystem<dim>::take_from_nodes(NodeField<Number>       &field,
                                   const Equations<Vector> &equations) const
  {
    Number *const values = field.begin();
    auto          motion = node_motions.begin();
    for (const CoupledNode &node : coupled_nodes)
      {
        const auto end = node_motions.begin() + node.end_of_motions;
        for (; motion != end; ++motion)
          equations.motions[motion->unknown] +=
            motion->factor * values[n * node.local + motion->component];
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double value         = values[n * node.local + d];
            values[n * node.local + d] = 0;
            values[n * node.master + d] += node.factors[d] * value;
          }
      }
    for (const IdentifiedVertex &vertex : identified_vertices)
      {
        values[n * vertex.master + dim] += values[n * vertex.local + dim];
        values[n * vertex.local + dim] = 0;
      }
    field.compress(VectorOperation::add);

    const unsigned int n_owned = mesh.owned_nodes().n_elements();
    auto *const        u       = equations.velocity.begin();
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        u[dim * i + d] = values[n * i + d];
    for (unsigned int v = 0; v < vertex_nodes.size(); ++v)
      equations.pressure.local_element(v) = values[n * vertex_nodes[v] + dim];
  }



  /**
   * Work of the pressure drop and the flow rate, in the fluid and, for all
   * ranks on the first, in the particles.
   */
  template <int dim>
  template <typename Number>
  void
  FlowSystem<dim>::add_pressure_drop(NodeFields<Number>        &fields,
                                     std::vector<double>       &rates,
                                     const std::vector<double> &motions) const
  {
    if (!mesh.scene().pressure_driven())
      return;
    const unsigned int drop   = bodies.n_unknowns();
    const double       length = mesh.scene().length;
    for (unsigned int i = 0; i < node_volumes.size(); ++i)
      {
        const double rate = -node_volumes[i] / length;
        rates[drop] += rate * fields.given.begin()[n * i];
        fields.sums.begin()[n * i] += rate * motions[drop];
      }
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      for (unsigned int k = 0; k < drop; ++k)
        if (bodies.is_free(k))
          {
            const double rate =
              -bodies.meshed_share(k) * bodies.displaced_volume(k) / length;
            rates[drop] += rate * motions[k];
            rates[k] += rate * motions[drop];
          }
  }



  template <int dim>
  template <typename Vector>
  void
  FlowSystem<dim>::keep_what_is_known(const Equations<Vector> &dst,
                                      const Unknowns<Vector>  &src) const
  {
    const unsigned int n_owned = mesh.owned_nodes().n_elements();
    for (const CoupledNode &node : coupled_nodes)
      if (node.local < n_owned)
        for (unsigned int d = 0; d < dim; ++d)
          if (node.master != node.local || node.factors[d] == 0.)
            dst.velocity.local_element(dim * node.local + d) =
              src.velocity.local_element(dim * node.local + d);
    for (unsigned int k = 0; k < bodies.n_unknowns(); ++k)
      if (!bodies.is_free(k))
        dst.motions[k] = src.motions[k];
  }



  /**
   * @param add_cells the sums over the cells, from node to node
   */
  template <int dim>
  template <typename Number, typename Vector, typename AddCells>
  void
  FlowSystem<dim>::multiply(NodeFields<Number>      &fields,
                            const Equations<Vector> &dst,
                            const Unknowns<Vector>  &src,
                            const AddCells          &add_cells) const
  {
    Assert(has_coupled_nodes, ExcNotInitialized());
    give_nodes(fields.given, src);
    fields.sums = 0.;
    add_cells(fields.sums.begin(), fields.given.begin());
    dst.motions.assign(n_rigid(), 0.);
    add_pressure_drop(fields, dst.motions, src.motions);
    take_from_nodes(fields.sums, dst);
    if (n_rigid() > 0)
      Utilities::MPI::sum(dst.motions, mesh.communicator(), dst.motions);
    keep_what_is_known(dst, src);
  }



  template <int dim>
  template <typename Number, typename Vector>
  void
  FlowSystem<dim>::vmult(const Equations<Vector> &dst,
                         const Unknowns<Vector>  &src) const
  {
    const auto add_cells = [&](Number *to, const Number *from) {
      cells.add_product(to, from);
    };
    if constexpr (std::is_same_v<Number, float>)
      multiply(fast_fields, dst, src, add_cells);
    else
      multiply(fields, dst, src, add_cells);
  }



  template <int dim>
  void
  FlowSystem<dim>::Tvmult(const Equations<FastVectorType> &dst,
                          const Unknowns<FastVectorType>  &src) const
  {
    multiply(fast_fields, dst, src, [&](float *to, const float *from) {
      cells.add_transposed_product(to, from);
    });
  }



  template <int dim>
  void
  FlowSystem<dim>::set_right_hand_side(NodeField<double> &forces)
  {
    collect_coupled_nodes();
    fields.given = 0.;
    for (const CoupledNode &node : coupled_nodes)
      {
        const NodeCoupling<dim> &coupling =
          couplings[node_partitioner.local_to_global(node.local)];
        for (unsigned int d = 0; d < dim; ++d)
          fields.given.begin()[n * node.local + d] = -coupling.known[d];
      }
    cells.add_product(forces.begin(), fields.given.begin());

    const std::vector<double> at_rest(n_rigid(), 0.);
    rigid_rhs   = at_rest;
    fields.sums = 0.;
    add_pressure_drop(fields, rigid_rhs, at_rest);
    take_from_nodes(
      forces, Equations<VectorType>{velocity_rhs, pressure_rhs, rigid_rhs});
    if (n_rigid() > 0)
      Utilities::MPI::sum(rigid_rhs, mesh.communicator(), rigid_rhs);
    if (mesh.scene().pressure_driven())
      rigid_rhs[bodies.n_unknowns()] -= mesh.scene().section();
  }



  /**
   * From what it leaves in single precision, of the whole velocity: that of the
   * disturbance alone may be zero.
   */
  template <int dim>
  double
  FlowSystem<dim>::rounding(const VectorType &velocity) const
  {
    fields.given = 0.;
    for (unsigned int i = 0; i < mesh.owned_nodes().n_elements(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        fields.given.local_element(n * i + d) =
          velocity.local_element(dim * i + d);
    fields.given.update_ghost_values();
    std::copy_n(fields.given.begin(),
                layout->locally_owned_size() + layout->n_ghost_indices(),
                fast_fields.given.begin());
    fields.sums      = 0.;
    fast_fields.sums = 0.;
    cells.add_product(fields.sums.begin(), fields.given.begin());
    cells.add_product(fast_fields.sums.begin(), fast_fields.given.begin());
    fields.sums.compress(VectorOperation::add);
    fast_fields.sums.compress(VectorOperation::add);
    double square = 0.;
    for (unsigned int i = 0; i < layout->locally_owned_size(); ++i)
      {
        const double difference =
          fields.sums.local_element(i) - fast_fields.sums.local_element(i);
        square += difference * difference;
      }
    return double_to_single *
           std::sqrt(Utilities::MPI::sum(square, mesh.communicator()));
  }



  template class FlowSystem<2>;
  template class FlowSystem<3>;
  template void
  FlowSystem<2>::vmult<double>(const Equations<VectorType> &,
                               const Unknowns<VectorType> &) const;
  template void
  FlowSystem<3>::vmult<double>(const Equations<VectorType> &,
                               const Unknowns<VectorType> &) const;
  template void
  FlowSystem<2>::vmult<float>(const Equations<VectorType> &,
                              const Unknowns<VectorType> &) const;
  template void
  FlowSystem<3>::vmult<float>(const Equations<VectorType> &,
                              const Unknowns<VectorType> &) const;
  template void
  FlowSystem<2>::vmult<float>(const Equations<FastVectorType> &,
                              const Unknowns<FastVectorType> &) const;
  template void
  FlowSystem<3>::vmult<float>(const Equations<FastVectorType> &,
                              const Unknowns<FastVectorType> &) const;
} // namespace Catena

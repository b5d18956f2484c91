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

    /// Rounding in double precision against that in single, with some reserve.
    constexpr double double_to_single = 1e-8;
  } // namespace



  template <int dim>
  FlowSystem<dim>::FlowSystem(const MovingMesh<dim>                &mesh,
                              const RigidBodies<dim>               &bodies,
                              const std::vector<NodeCoupling<dim>> &couplings)
    : vertex_volumes(mesh.owned_scalars(), mesh.communicator())
    , velocity_rhs(mesh.owned_vectors(), mesh.communicator())
    , pressure_rhs(mesh.owned_scalars(), mesh.communicator())
    , rigid_rhs(bodies.n_unknowns() + (mesh.scene().pressure_driven() ? 1 : 0))
    , mesh(mesh)
    , bodies(bodies)
    , couplings(couplings)
    , node_partitioner(mesh.owned_nodes(),
                       mesh.relevant_nodes(),
                       mesh.communicator())
  {
    cells = FlowCells<dim, double>(mesh, node_partitioner);
    for (const auto vertex : mesh.owned_scalars())
      vertex_nodes.push_back(
        node_partitioner.global_to_local(mesh.node_of_vertex(vertex)));
    for (const auto node : mesh.relevant_nodes())
      {
        const NodeCoupling<dim> &coupling = couplings[node];
        const unsigned int       local = node_partitioner.global_to_local(node);
        const auto is_one              = [](const double f) { return f == 1.; };
        if (coupling.master != node || !std::all_of(coupling.factors.begin(),
                                                    coupling.factors.end(),
                                                    is_one))
          coupled_nodes.push_back(
            {static_cast<unsigned int>(node),
             local,
             node_partitioner.global_to_local(coupling.master)});
        const auto ends   = mesh.edge_ends(node);
        const auto master = mesh.identification().master(node);
        if (ends[0] == ends[1] && master != node)
          identified_vertices.push_back(
            {local, node_partitioner.global_to_local(master)});
      }
    given      = node_field<double>();
    sums       = given;
    fast_given = node_field<float>();
    fast_sums  = fast_given;
  }



  template <int dim>
  template <typename Number>
  typename FlowSystem<dim>::template NodeField<Number>
  FlowSystem<dim>::node_field() const
  {
    return NodeField<Number>(node_dofs(mesh.owned_nodes(), n),
                             node_dofs(node_partitioner.ghost_indices(), n),
                             mesh.communicator());
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

    for (const CoupledNode &node : coupled_nodes)
      {
        const NodeCoupling<dim> &coupling = couplings[node.node];
        for (unsigned int d = 0; d < dim; ++d)
          {
            double value = coupling.factors[d] * values[n * node.master + d];
            for (const auto &motion : coupling.motions[d])
              value += motion.second * unknowns.motions[motion.first];
            values[n * node.local + d] = value;
          }
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
    for (const CoupledNode &node : coupled_nodes)
      {
        const NodeCoupling<dim> &coupling = couplings[node.node];
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double value         = values[n * node.local + d];
            values[n * node.local + d] = 0;
            values[n * node.master + d] += coupling.factors[d] * value;
            for (const auto &motion : coupling.motions[d])
              equations.motions[motion.first] += motion.second * value;
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
  FlowSystem<dim>::add_pressure_drop(NodeField<Number>         &sums,
                                     std::vector<double>       &rates,
                                     const NodeField<Number>   &given,
                                     const std::vector<double> &motions) const
  {
    if (!mesh.scene().pressure_driven())
      return;
    const unsigned int drop   = bodies.n_unknowns();
    const double       length = mesh.scene().length;
    for (unsigned int i = 0; i < node_volumes.size(); ++i)
      {
        const double rate = -node_volumes[i] / length;
        rates[drop] += rate * given.begin()[n * i];
        sums.begin()[n * i] += rate * motions[drop];
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
          if (node.master != node.local ||
              couplings[node.node].factors[d] == 0.)
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
  FlowSystem<dim>::multiply(NodeField<Number>       &from,
                            NodeField<Number>       &to,
                            const Equations<Vector> &dst,
                            const Unknowns<Vector>  &src,
                            const AddCells          &add_cells) const
  {
    give_nodes(from, src);
    to = 0.;
    add_cells(to.begin(), from.begin());
    dst.motions.assign(n_rigid(), 0.);
    add_pressure_drop(to, dst.motions, from, src.motions);
    take_from_nodes(to, dst);
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
    if constexpr (std::is_same_v<Number, float>)
      multiply(
        fast_given, fast_sums, dst, src, [&](auto *to, const auto *from) {
          fast_cells.add_product(to, from);
        });
    else
      multiply(given, sums, dst, src, [&](auto *to, const auto *from) {
        cells.add_product(to, from);
      });
  }



  template <int dim>
  void
  FlowSystem<dim>::Tvmult(const Equations<FastVectorType> &dst,
                          const Unknowns<FastVectorType>  &src) const
  {
    multiply(fast_given, fast_sums, dst, src, [&](auto *to, const auto *from) {
      fast_cells.add_transposed_product(to, from);
    });
  }



  template <int dim>
  void
  FlowSystem<dim>::set_right_hand_side(NodeField<double> &forces)
  {
    given = 0.;
    for (const CoupledNode &node : coupled_nodes)
      for (unsigned int d = 0; d < dim; ++d)
        given.begin()[n * node.local + d] = -couplings[node.node].known[d];
    cells.add_product(forces.begin(), given.begin());

    const std::vector<double> at_rest(n_rigid(), 0.);
    rigid_rhs = at_rest;
    add_pressure_drop(forces, rigid_rhs, given, at_rest);
    take_from_nodes(
      forces, Equations<VectorType>{velocity_rhs, pressure_rhs, rigid_rhs});
    if (n_rigid() > 0)
      Utilities::MPI::sum(rigid_rhs, mesh.communicator(), rigid_rhs);
    if (mesh.scene().pressure_driven())
      rigid_rhs[bodies.n_unknowns()] -= mesh.scene().section();
  }



  /**
   * From what it leaves in single precision.
   */
  template <int dim>
  double
  FlowSystem<dim>::rounding(const VectorType &velocity) const
  {
    given      = 0.;
    fast_given = 0.;
    sums       = 0.;
    fast_sums  = 0.;
    for (const auto node : mesh.relevant_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = n * node_partitioner.global_to_local(node) + d;
          given.local_element(i)      = velocity(dim * node + d);
          fast_given.local_element(i) = velocity(dim * node + d);
        }
    cells.add_product(sums.begin(), given.begin());
    fast_cells.add_product(fast_sums.begin(), fast_given.begin());
    sums.compress(VectorOperation::add);
    fast_sums.compress(VectorOperation::add);
    double square = 0.;
    for (unsigned int i = 0; i < sums.locally_owned_size(); ++i)
      {
        const double difference =
          sums.local_element(i) - fast_sums.local_element(i);
        square += difference * difference;
      }
    return double_to_single *
           std::sqrt(Utilities::MPI::sum(square, mesh.communicator()));
  }



  template class FlowSystem<2>;
  template class FlowSystem<3>;
  template FlowSystem<2>::NodeField<double>
  FlowSystem<2>::node_field() const;
  template FlowSystem<3>::NodeField<double>
  FlowSystem<3>::node_field() const;
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

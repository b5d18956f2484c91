#include <catena/flow/node_couplings.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  std::vector<NodeCoupling<dim>>
  node_couplings(const MovingMesh<dim>           &mesh,
                 const AffineConstraints<double> &constraints)
  {
    const types::global_dof_index  n_velocity = mesh.vector_dofs().n_dofs();
    std::vector<NodeCoupling<dim>> couplings(mesh.n_global_nodes());
    for (const auto node : mesh.relevant_nodes())
      {
        NodeCoupling<dim> &coupling = couplings[node];
        coupling.master             = node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const types::global_dof_index dof = dim * node + d;
            coupling.factors[d]               = 1.;
            coupling.known[d]                 = 0.;
            if (!constraints.is_constrained(dof))
              continue;
            coupling.factors[d] = 0.;
            coupling.known[d]   = constraints.get_inhomogeneity(dof);
            for (const auto &entry : *constraints.get_constraint_entries(dof))
              if (entry.first >= n_velocity)
                coupling.motions.push_back(
                  {d,
                   static_cast<unsigned int>(entry.first - n_velocity),
                   entry.second});
              else
                {
                  coupling.master     = entry.first / dim;
                  coupling.factors[d] = entry.second;
                }
          }
      }
    return couplings;
  }



  template std::vector<NodeCoupling<2>>
  node_couplings<2>(const MovingMesh<2> &, const AffineConstraints<double> &);
  template std::vector<NodeCoupling<3>>
  node_couplings<3>(const MovingMesh<3> &, const AffineConstraints<double> &);
} // namespace Catena

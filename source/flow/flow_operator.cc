#include <catena/base/replicated.h>
#include <catena/flow/flow_operator.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  void
  FlowOperator<dim>::vmult(BlockVectorType       &dst,
                           const BlockVectorType &src) const
  {
    if (precision == Precision::single_precision)
      {
        matrices.fast_velocity.vmult(dst.block(0), src.block(0));
        matrices.fast_gradient.vmult_add(dst.block(0), src.block(1));
        matrices.fast_divergence.vmult(dst.block(1), src.block(0));
      }
    else
      {
        matrices.velocity.vmult(dst.block(0), src.block(0));
        matrices.gradient.vmult_add(dst.block(0), src.block(1));
        matrices.divergence.vmult(dst.block(1), src.block(0));
      }
    if (matrices.n_rigid() == 0)
      return;
    const std::vector<double> motions = replicate(src.block(2));
    std::vector<double>       contact_forces, forces(motions.size());
    if (src.n_blocks() > 3)
      contact_forces = replicate(src.block(3));
    matrices.velocity_rigid_product.vmult_add(dst.block(0), motions);
    matrices.pressure_rigid_product.vmult_add(dst.block(1), motions);
    matrices.rigid_velocity_product.Tvmult_add(forces, src.block(0));
    matrices.pressure_rigid_product.Tvmult_add(forces, src.block(1));
    Utilities::MPI::sum(forces, src.block(0).get_mpi_communicator(), forces);
    for (const auto k : dst.block(2).locally_owned_elements())
      {
        for (unsigned int l = 0; l < motions.size(); ++l)
          forces[k] += matrices.rigid_rigid(k, l) * motions[l];
        for (unsigned int c = 0; c < contact_forces.size(); ++c)
          forces[k] -=
            contacts.shares[c] * contacts.rates(c, k) * contact_forces[c];
        dst.block(2)(k) = forces[k];
      }
    if (src.n_blocks() > 3)
      for (const auto c : dst.block(3).locally_owned_elements())
        {
          double rate = 0.;
          for (unsigned int l = 0; l < motions.size(); ++l)
            rate += contacts.rates(c, l) * motions[l];
          dst.block(3)(c) = rate;
        }
  }



  template struct FlowOperator<2>;
  template struct FlowOperator<3>;
} // namespace Catena

#include <catena/flow/flow_operator.h>
#include <catena/flow/flow_preconditioner.h>

namespace Catena
{
  template <int dim>
  void
  FlowOperator<dim>::vmult(BlockVectorType       &dst,
                           const BlockVectorType &src) const
  {
    matrices.velocity_product.vmult(dst.block(0), src.block(0));
    matrices.gradient_product.vmult_add(dst.block(0), src.block(1));
    matrices.divergence_product.vmult(dst.block(1), src.block(0));
    if (matrices.n_rigid() == 0)
      return;
    matrices.velocity_rigid.vmult_add(dst.block(0), src.block(2));
    matrices.pressure_rigid.vmult_add(dst.block(1), src.block(2));
    matrices.rigid_velocity_transposed.Tvmult(dst.block(2), src.block(0));
    matrices.pressure_rigid.Tvmult_add(dst.block(2), src.block(1));

    const std::vector<double> motions = replicate(src.block(2));
    std::vector<double>       forces;
    if (src.n_blocks() > 3)
      forces = replicate(src.block(3));
    for (const auto k : dst.block(2).locally_owned_elements())
      {
        double sum = 0.;
        for (unsigned int l = 0; l < motions.size(); ++l)
          sum += matrices.rigid_rigid(k, l) * motions[l];
        for (unsigned int c = 0; c < forces.size(); ++c)
          sum -= contacts.shares[c] * contacts.rates(c, k) * forces[c];
        dst.block(2)(k) += sum;
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

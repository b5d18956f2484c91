#include <catena/base/replicated.h>
#include <catena/flow/flow_operator.h>

namespace Catena
{
  using namespace dealii;

  template <int dim, typename Number>
  template <typename BlockVector>
  void
  FlowOperator<dim, Number>::vmult(BlockVector       &dst,
                                   const BlockVector &src) const
  {
    std::vector<double> motions, forces, contact_forces;
    if (src.n_blocks() > 2)
      motions = replicate(src.block(2));
    if (src.n_blocks() > 3)
      contact_forces = replicate(src.block(3));
    using Vector = typename BlockVector::BlockType;
    using System = FlowSystem<dim>;
    system.template vmult<Number>(
      typename System::template Equations<Vector>{dst.block(0),
                                                  dst.block(1),
                                                  forces},
      typename System::template Unknowns<Vector>{src.block(0),
                                                 src.block(1),
                                                 motions});
    if (motions.empty())
      return;
    for (const auto k : dst.block(2).locally_owned_elements())
      {
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



  template void
  FlowOperator<2, double>::vmult(BlockVectorType &,
                                 const BlockVectorType &) const;
  template void
  FlowOperator<3, double>::vmult(BlockVectorType &,
                                 const BlockVectorType &) const;
  template void
  FlowOperator<2, float>::vmult(BlockVectorType &,
                                const BlockVectorType &) const;
  template void
  FlowOperator<3, float>::vmult(BlockVectorType &,
                                const BlockVectorType &) const;
  template void
  FlowOperator<2, float>::vmult(FastBlockVectorType &,
                                const FastBlockVectorType &) const;
  template void
  FlowOperator<3, float>::vmult(FastBlockVectorType &,
                                const FastBlockVectorType &) const;
} // namespace Catena

#ifndef catena_flow_flow_operator_h
#define catena_flow_flow_operator_h

#include <catena/flow/flow_matrices.h>
#include <catena/particles/acting_contacts.h>

namespace Catena
{
  /**
   * The system of FlowMatrices with contacts, applied block by block: to the
   * unknowns (u', p, r, F_r) it has the rows of FlowMatrices, less the force
   * shares F_r rates^T of the contacts, and the gap rates rates r.
   */
  template <int dim>
  struct FlowOperator
  {
    const FlowMatrices<dim> &matrices;
    const ContactBlocks     &contacts;

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const;
  };
} // namespace Catena

#endif

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
    /// Of the entries of the large blocks A, B and B^T.
    enum class Precision
    {
      double_precision,
      single_precision
    };

    const FlowMatrices<dim> &matrices;
    const ContactBlocks     &contacts;
    Precision                precision = Precision::double_precision;

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const;
  };
} // namespace Catena

#endif

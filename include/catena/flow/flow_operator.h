#ifndef catena_flow_flow_operator_h
#define catena_flow_flow_operator_h

#include <catena/flow/flow_system.h>
#include <catena/particles/acting_contacts.h>

namespace Catena
{
  /**
   * FlowSystem with contacts: to the
   * unknowns (u', p, r, F_r) it has the rows of FlowSystem, less the force
   * shares F_r rates^T of the contacts, and the gap rates rates r.
   */
  template <int dim>
  struct FlowOperator
  {
    /// Of the sums over cells.
    enum class Precision
    {
      double_precision,
      single_precision
    };

    const FlowSystem<dim> &system;
    const ContactBlocks   &contacts;
    Precision              precision = Precision::double_precision;

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const;
  };
} // namespace Catena

#endif

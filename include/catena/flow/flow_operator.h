#ifndef catena_flow_flow_operator_h
#define catena_flow_flow_operator_h

#include <catena/flow/flow_system.h>
#include <catena/particles/acting_contacts.h>

namespace Catena
{
  /**
   * FlowSystem with contacts: to the unknowns (u', p, r, F_r) it has the rows
   * of FlowSystem, less the force shares F_r rates^T of the contacts, and the
   * gap rates rates r.
   *
   * @tparam Number of the sums over the cells
   */
  template <int dim, typename Number>
  struct FlowOperator
  {
    const FlowSystem<dim> &system;
    const ContactBlocks   &contacts;

    /// @tparam BlockVector BlockVectorType or, in single precision,
    /// FastBlockVectorType
    template <typename BlockVector>
    void
    vmult(BlockVector &dst, const BlockVector &src) const;
  };
} // namespace Catena

#endif

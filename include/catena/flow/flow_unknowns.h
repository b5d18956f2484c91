#ifndef catena_flow_flow_unknowns_h
#define catena_flow_flow_unknowns_h

#include <catena/base/types.h>
#include <catena/flow/flow_fields.h>
#include <catena/flow/flow_system.h>
#include <catena/flow/node_couplings.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/particles/acting_contacts.h>
#include <catena/particles/contacts.h>
#include <catena/particles/rigid_bodies.h>

#include <vector>

namespace Catena
{
  /**
   * What the vectors of unknowns (u', p, r, F_r) of FlowSystem with contacts
   * mean: the velocity u is that of the imposed flow and u', the motions of the
   * particles are their reference motions and r, and the pressure has the mean
   * zero.
   */
  template <int dim>
  struct FlowUnknowns
  {
    const MovingMesh<dim>                &mesh;
    const RigidBodies<dim>               &bodies;
    const Configuration<dim>             &configuration;
    const bool                            held;
    const std::vector<NodeCoupling<dim>> &couplings;
    const FlowSystem<dim>                &system;

    /// Zero; without contacts there is no block for their forces.
    BlockVectorType
    make_vector(const unsigned int n_contacts) const;

    /// The equations of @p contacts, for r.
    ContactBlocks
    contact_blocks(const std::vector<Contact<dim>> &contacts) const;

    BlockVectorType
    right_hand_side(const ContactBlocks       &contacts,
                    const std::vector<double> &external_forces) const;

    /// The unknowns of @p fields, and @p contact_forces.
    BlockVectorType
    first_guess(const FlowFields<dim>     &fields,
                const std::vector<double> &contact_forces) const;

    /// r of @p fields: the motions against the reference ones, and the pressure
    /// drop.
    std::vector<double>
    global_unknowns(const FlowFields<dim> &fields) const;

    /**
     * Take away what no equation sees: the mean over the volume of the fluid,
     * and what identified vertices have besides their masters.
     */
    void
    normalise_pressure(VectorType &pressure) const;

    /**
     * The fields of @p solution.
     * @param set which of the candidates for contacts its forces belong to
     */
    void
    extract(const BlockVectorType   &solution,
            const std::vector<bool> &set,
            FlowFields<dim>         &fields) const;

    /// Velocity, motions and pressure drop alone.
    void
    extract_velocity(const BlockVectorType &solution,
                     FlowFields<dim>       &fields) const;
  };
} // namespace Catena

#endif

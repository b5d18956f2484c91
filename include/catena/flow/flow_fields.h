#ifndef catena_flow_flow_fields_h
#define catena_flow_flow_fields_h

#include <catena/base/types.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/particles/rigid_bodies.h>
#include <catena/scene/configuration.h>

#include <vector>

namespace Catena
{
  /**
   * Velocity and pressure of an instant with the motions of the particles and
   * the forces in their contacts. Units a gamma, eta0 gamma, and
   * eta0 gamma a^2 for forces.
   */
  template <int dim>
  struct FlowFields
  {
    VectorType                    velocity;
    VectorType                    pressure;
    std::vector<RigidMotion<dim>> motions;
    /// F_r >= 0, by candidate contact
    std::vector<double> contact_forces;
    /**
     * P, by which the pressure falls along a period of a pressure-driven
     * scene: it is `pressure` - P x/L.
     */
    double pressure_drop = 0.;
    /// force and torque that hold each particle in place, by rigid-body
    /// unknown, see particle_forces(); found when a particle is held
    std::vector<double> reactions;
  };



  /**
   * a x + b y; @p x if b is zero, for a = 1. Of forces that are not there for
   * the same contacts, and of reactions, those of @p x.
   */
  template <int dim>
  FlowFields<dim>
  combination(const double           a,
              const FlowFields<dim> &x,
              const double           b,
              const FlowFields<dim> &y);

  /**
   * The imposed flow at the positions of the mesh, with the particles moving as
   * reference_motions() has it and without a pressure: a first guess.
   */
  template <int dim>
  FlowFields<dim>
  imposed_flow(const MovingMesh<dim>    &mesh,
               const Configuration<dim> &configuration,
               const bool                held_in_place);
} // namespace Catena

#endif

#ifndef catena_simulation_state_h
#define catena_simulation_state_h

#include <catena/base/types.h>
#include <catena/flow/flow_fields.h>
#include <catena/mesh/field_archive.h>
#include <catena/mesh/mesh_mover.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/mesh/point_tensors.h>
#include <catena/scene/configuration.h>

#include <memory>
#include <vector>

namespace Catena
{
  /**
   * A mesh and what moves it.
   */
  template <int dim>
  struct Discretization
  {
    std::unique_ptr<MovingMesh<dim>> mesh;
    std::unique_ptr<MeshMover<dim>>  mover;
    /// quality of the mesh when it was made
    double initial_quality = 0.;
    /// how many it took to make it, see MeshDescription
    unsigned int attempts = 1;

    /**
     * Save or load it: the mesh as vertices and cells, the planes that bound
     * it, the places of the particles it was made for.
     * @param scene the scene at the start
     */
    void
    archive(Archive          &archive,
            const Scene<dim> &scene,
            const MPI_Comm    communicator);
  };



  /**
   * Everything that is known of one instant, on the present mesh.
   */
  template <int dim>
  struct Level
  {
    /// strain gamma t since the release of the particles
    double             time = 0.;
    Configuration<dim> configuration;
    VectorType         positions;
    FlowFields<dim>    flow;
    /// components of log(c) in deal.II's order; empty for a Newtonian fluid
    std::vector<VectorType> log_conformation;
    /// c' of StressPrediction; none for a Newtonian fluid and at the start
    PointTensors<dim> unresolved_conformation;
    /// Is it the end of a step of second order, with a stress of flow and
    /// conformation that balances the forces? So it is but for the start and
    /// when the walls have just turned back.
    bool is_balanced = false;

    /// Save or load it.
    void
    archive(FieldArchive<dim> &archive);
  };



  /**
   * What the next step needs.
   */
  template <int dim>
  struct State
  {
    Discretization<dim> discretization;
    Level<dim>          now, before;
    /// time step that led to `now`, 0 at the start
    double last_dt = 0.;
    /// force that holds each particle, by rigid-body unknown, before its ramp
    std::vector<double> holding_forces;

    /// Save or load it, as Discretization::archive() does.
    void
    archive(Archive          &archive,
            const Scene<dim> &scene,
            const MPI_Comm    communicator);
  };
} // namespace Catena

#endif

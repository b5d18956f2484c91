#ifndef catena_simulation_remesher_h
#define catena_simulation_remesher_h

#include <catena/simulation/parameters.h>
#include <catena/simulation/state.h>

namespace Catena
{
  /**
   * Decides when the mesh has moved too far, makes a new one and carries the
   * state over to it.
   *
   * The new mesh is made for the configuration of the coming instant, and the
   * mesh mover tells where its nodes were at the earlier instants. The
   * log-conformation and the velocity of each level are then taken from the
   * old mesh at those places and times: the new mesh has the past it would
   * have had if it had always been there. Its stress is to be balanced there,
   * see StressBalance.
   */
  template <int dim>
  class Remesher
  {
  public:
    Remesher(const Scene<dim>           &scene,
             const SimulationParameters &parameters,
             const MPI_Comm              communicator);

    /**
     * A mesh for @p configuration, with its nodes at their positions there.
     *
     * With MeshParameters::gap_stretch > 1 it is made for particles moved apart
     * to where the narrowest gap is as many times wider (but no wider than what
     * the elements of the surfaces resolve anyway), and the mesh mover closes
     * the gaps again: the elements in them are pressed flat. Where that inverts
     * one, as can happen if elements are as large as gaps, the mesh is made for
     * the particles where they are.
     *
     * @throws MeshError if the mesher fails or that mesh is inverted too,
     * SolverError if the mesh cannot be moved
     */
    Discretization<dim>
    make(const Configuration<dim> &configuration) const;

    /**
     * Is a new mesh needed? Looks at the quality at the mesh's current
     * positions, at the elements across gaps, and for particles that have left
     * the block.
     */
    bool
    is_due(const Discretization<dim> &discretization,
           const Configuration<dim>  &configuration) const;

    /**
     * Put the state on a new mesh for @p next. If another image of a particle
     * lies in the new block, the particle is represented by it from then on,
     * in the state and in @p next.
     *
     * @throws MeshError or SolverError; state and @p next are as before then
     */
    void
    remesh(State<dim> &state, Configuration<dim> &next) const;

  private:
    const Scene<dim>           scene;
    const SimulationParameters parameters;
    const MPI_Comm             communicator;

    Configuration<dim>
    widened(const Configuration<dim> &configuration) const;

    /// The scene with the planes that bound the meshed block where they suit
    /// particles at @p configuration best.
    Scene<dim>
    layout_for(const Configuration<dim> &configuration) const;

    Discretization<dim>
    make(const Scene<dim>         &layout,
         const Configuration<dim> &configuration) const;

    /// Represent each particle by its image in the block of @p layout.
    void
    choose_images(const Scene<dim>   &layout,
                  State<dim>         &state,
                  Configuration<dim> &next) const;

    void
    replace_by_image(const Image<dim>  &image,
                     const unsigned int particle,
                     State<dim>        &state) const;
  };



  /**
   * Number of elements across the gap between two surface points: its width
   * over the extent along it of the cells it passes through. Collective.
   */
  template <int dim>
  double
  elements_across(const MovingMesh<dim>    &mesh,
                  const dealii::Point<dim> &begin,
                  const dealii::Point<dim> &end);
} // namespace Catena

#endif

#ifndef catena_mesh_mesh_mover_h
#define catena_mesh_mesh_mover_h

#include <catena/mesh/field_archive.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/scene/configuration.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <list>
#include <vector>

namespace Catena
{
  /**
   * Node positions as a function of where the particles are.
   *
   * The displacement d from the reference mesh solves div(k grad d) = 0 on
   * the reference mesh in P1, with k = (element size)^-2 so that small
   * elements near particles and gaps move almost rigidly. On particle i
   *
   *   d = X_i - X_i,ref + (R - I)(x - X_i,ref),
   *
   * R being the rotation by the angle the frame has turned since the mesh was
   * made: the mesh in a gap turns with a pair instead of being sheared. The
   * mesh slides along walls in the direction of the flow, mirror planes stay
   * planes, identified planes move as images of each other. Mid-nodes stay in
   * the middle of their edges, or on their sphere.
   *
   * Because the positions depend on the configuration alone, the mesh at
   * earlier times is known from the earlier places of the particles: a new
   * mesh has the same past as the one it replaces.
   */
  template <int dim>
  class MeshMover
  {
  public:
    /**
     * @param mesh the mesh to move; must outlive the mover
     * @param reference the configuration the mesh was made for
     */
    MeshMover(const MovingMesh<dim> &mesh, const Configuration<dim> &reference);

    /**
     * Node positions for @p configuration.
     * @throws SolverError if the Laplace problem does not converge
     */
    VectorType
    positions(const Configuration<dim> &configuration) const;

    /// The configuration the mesh was made for.
    const Configuration<dim> &
    reference_configuration() const
    {
      return reference;
    }

    /// Save or load the first guess of the next positions.
    void
    archive(FieldArchive<dim> &archive);

  private:
    const MovingMesh<dim>   &mesh;
    const Configuration<dim> reference;

    /**
     * The Laplace problem of one or more components with the same
     * constraints: the factor of each node against its master (0: prescribed).
     */
    struct Problem
    {
      std::vector<unsigned int> components;
      std::vector<signed char>  factors;

      dealii::TrilinosWrappers::SparseMatrix    matrix;
      dealii::TrilinosWrappers::PreconditionAMG preconditioner;
    };
    std::list<Problem>                     problems;
    dealii::TrilinosWrappers::SparseMatrix stiffness;

    /// last displacement of each component, the first guess of the next
    mutable std::array<VectorType, dim> displacements;

    signed char
    factor(const unsigned int vertex, const unsigned int component) const;

    void
    assemble();

    void
    solve(const Problem     &problem,
          const unsigned int component,
          VectorType        &displacement) const;

    dealii::Tensor<1, dim>
    particle_displacement(const unsigned int        node,
                          const dealii::Point<dim> &point,
                          const Configuration<dim> &configuration) const;
  };
} // namespace Catena

#endif

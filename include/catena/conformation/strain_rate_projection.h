#ifndef catena_conformation_strain_rate_projection_h
#define catena_conformation_strain_rate_projection_h

#include <catena/base/types.h>
#include <catena/conformation/tensor_identification.h>
#include <catena/mesh/moving_mesh.h>

#include <vector>

namespace Catena
{
  /**
   * The rate of strain of a P2 velocity as the conformation sees it: its L2
   * projection D_h onto continuous P1 tensors,
   *
   *   int (D_h - D(u)) : E = 0  for all E,
   *
   * in components of deal.II's SymmetricTensor. The difference of the two is
   * what no elastic stress resists.
   */
  template <int dim>
  class StrainRateProjection
  {
  public:
    /**
     * On the present positions of @p mesh, which is kept by reference.
     */
    explicit StrainRateProjection(const MovingMesh<dim> &mesh);

    /**
     * @throws SolverError
     */
    std::vector<VectorType>
    project(const VectorType &velocity) const;

  private:
    static constexpr unsigned int n_components = n_symmetric_components(dim);
    static constexpr unsigned int n_vertices   = n_linear_nodes(dim);

    using CellMass = std::array<std::array<double, n_vertices>, n_vertices>;

    class Mass;

    /// Adds a value at a vertex of a cell to the equations of its master.
    void
    add(BlockVectorType                       &equations,
        const unsigned int                     vertex,
        const dealii::SymmetricTensor<2, dim> &value) const;

    const MovingMesh<dim>          &mesh;
    const TensorIdentification<dim> identification;
    std::vector<CellMass>           masses; // by cell
  };
} // namespace Catena

#endif

#ifndef catena_simulation_stress_balance_h
#define catena_simulation_stress_balance_h

#include <catena/flow/stress_model.h>
#include <catena/mesh/point_tensors.h>
#include <catena/rheology/giesekus.h>
#include <catena/simulation/state.h>

#include <vector>

namespace Catena
{
  /**
   * Brings the stress sigma of an instant, transferred from another mesh, into
   * balance with the forces F on the particles. It was for the velocities of
   * that mesh,
   *
   *   int sigma : D(v) = F.v   for all v with div v = 0,
   *
   * and is not for those of this one: by as much as two meshes differ, but all
   * at once. Motions and forces would jump, and be back within the memory time
   * M of StressPrediction. What is missing is the stress 2 D(e) of a slow flow,
   *
   *   int (2 D(e) - q I + T) : D(v) = F.v   for all v,   div e = 0,
   *
   * between walls at rest, of all the one with the least int |D(e)|^2. With
   *
   *   T = 2 (beta + theta) D(u) - 2 theta D_h + G (c_p - I),   c_p = exp(s) +
   * c',
   *
   * u is the flow of this instant also on this mesh when c' gets (2/G) D(e) in
   * addition. It is forgotten like the rest of c'.
   *
   * As a StressModel it is that of the flow e. Units eta0, gamma and a.
   */
  template <int dim>
  class StressBalance : public StressModel<dim>
  {
  public:
    /**
     * @param mesh at the positions of the instant
     * @param level flow and conformation of the instant. All are kept by
     * reference.
     * @param last_velocity of the instant before, of which D_h is, the smooth
     * rate of strain in the numerical viscosity of StressPrediction
     * @throws SolverError if D_h is not found
     */
    StressBalance(const MovingMesh<dim> &mesh,
                  const Giesekus<dim>   &model,
                  const Level<dim>      &level,
                  const VectorType      &last_velocity);

    bool
    has_scalar_viscosity() const override
    {
      return true;
    }

    void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override;

    /// c' + (2/G) D(e)
    PointTensors<dim>
    sum(const PointTensors<dim> &unresolved, const VectorType &e) const;

  private:
    const MovingMesh<dim>  &mesh;
    const Giesekus<dim>    &model;
    const Level<dim>       &level;
    std::vector<VectorType> smooth_strain_rate;
  };
} // namespace Catena

#endif

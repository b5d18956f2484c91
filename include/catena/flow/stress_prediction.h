#ifndef catena_flow_stress_prediction_h
#define catena_flow_stress_prediction_h

#include <catena/base/time_history.h>
#include <catena/flow/stress_model.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/giesekus.h>

#include <vector>

namespace Catena
{
  /**
   * The viscoelastic stress predicted in terms of the new velocity gradient L
   * (D'Avino & Hulsen, J. Non-Newtonian Fluid Mech. 165 (2010) 1602),
   *
   *   sigma + p I = 2 beta D + G (c_pred - I),
   *   c_pred = -(a1 c^n + a2 c^(n-1))/a0
   *            + (dt/a0) [ -w.grad c^ + L c^ + c^ L^T + f(c^) ],
   *
   * with the BDF coefficients a, the velocity w = u^ - u_mesh against the
   * mesh, and ^ the extrapolation to the new instant; c^ = exp(s^) stays
   * positive. The tensor viscosity is H = beta I + (G dt/a0) c^: the momentum
   * balance is well posed also without solvent.
   *
   * With little solvent, motions that the continuous P1 stress does not see are
   * held by the part with c^ alone and grow the sooner the smaller the steps
   * are. Then a numerical viscosity is added on them, 2 theta (D - D_h^n) with
   * the smooth rate of strain D_h^n of the last instant (discrete
   * elastic-viscous stress splitting, Guenette & Fortin, J. Non-Newtonian Fluid
   * Mech. 60 (1995) 27): first order in time, nothing at a steady smooth flow.
   */
  template <int dim>
  class StressPrediction : public StressModel<dim>
  {
  public:
    /// Numerical viscosity theta of a fluid: what its solvent has less than
    /// 0.1 eta0.
    static double
    numerical_viscosity(const Giesekus<dim> &model);

    /**
     * @param log_conformation, old_log_conformation s at t^n and t^(n-1)
     * @param convection w at the P2 nodes
     * @param smooth_strain_rate components of D_h^n; without any there is no
     * numerical viscosity
     *
     * The fields are kept by reference.
     */
    StressPrediction(const Giesekus<dim>           &model,
                     const TimeStep                &step,
                     const std::vector<VectorType> &log_conformation,
                     const std::vector<VectorType> &old_log_conformation,
                     const VectorType              &convection,
                     const std::vector<VectorType> &smooth_strain_rate);

    void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override;

  private:
    void
    add_numerical_viscosity(
      const typename MovingMesh<dim>::Cell &cell,
      const CellValues<dim>                &values,
      std::vector<StressCoefficients<dim>> &coefficients) const;

    const Giesekus<dim>            model;
    const TimeStep                 step;
    const std::vector<VectorType> &log_conformation;
    const std::vector<VectorType> &old_log_conformation;
    const VectorType              &convection;
    const std::vector<VectorType> &smooth_strain_rate;
  };

} // namespace Catena

#endif

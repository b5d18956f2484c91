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
   *            + (dt/a0) [ L c^ + c^ L^T + f(c^) ] - m w.grad c^
   *            - (dt/a0 - m) [ L^n c^n + c^n L^nT + f(c^n)
   *                            - (c^n - c^(n-1))/dt^n ],
   *
   * with the BDF coefficients a, the velocity w = u^ - u_mesh against the
   * mesh, ^ the extrapolation to the new instant, dt^n = t^n - t^(n-1), and L^n
   * the gradient of u^n on the mesh as it is at the new instant; c^ = exp(s^)
   * stays positive. The tensor viscosity is H = beta I + (G dt/a0) c^: the
   * momentum balance is well posed also without solvent.
   *
   * At rest in time this is c + m r, r being what the equation of the
   * conformation leaves at a point for the P1 field, of the order of the
   * elements. With m = dt/a0, as published, the last line vanishes; but the
   * stress at rest depends on the step then, and long steps are unstable. So m
   * is at most the time in which the conformation at a point changes, or the
   * fluid crosses two elements of length h along w,
   * ((1/lambda + |L^n|)^2 + (|w|/2h)^2)^(-1/2), see Giesekus::time_of_change().
   * What that changes in the prediction is of second order in time. In a step
   * without a previous one m = dt/a0.
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
    /// Motion of the fluid that the prediction takes as known.
    struct Motion
    {
      /// w at the P2 nodes
      VectorType convection;
      /// u at t^n
      VectorType last_velocity;
      /// components of D_h^n; without any there is no numerical viscosity
      std::vector<VectorType> smooth_strain_rate;
    };

    /// Numerical viscosity theta of a fluid: what its solvent has less than
    /// 0.1 eta0.
    static double
    numerical_viscosity(const Giesekus<dim> &model);

    /**
     * @param log_conformation, old_log_conformation s at t^n and t^(n-1)
     * @param motion see Motion
     *
     * The fields and the motion are kept by reference.
     */
    StressPrediction(const Giesekus<dim>           &model,
                     const TimeStep                &step,
                     const std::vector<VectorType> &log_conformation,
                     const std::vector<VectorType> &old_log_conformation,
                     const Motion                  &motion);

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
    const Motion                  &motion;
  };

} // namespace Catena

#endif

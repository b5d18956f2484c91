#ifndef catena_flow_stress_prediction_h
#define catena_flow_stress_prediction_h

#include <catena/base/time_history.h>
#include <catena/flow/stress_model.h>
#include <catena/mesh/vertex_tensors.h>
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
   */
  template <int dim>
  class StressPrediction : public StressModel<dim>
  {
  public:
    /**
     * @param log_conformation, old_log_conformation s at t^n and t^(n-1)
     * @param convection w at the P2 nodes
     *
     * The fields are kept by reference.
     */
    StressPrediction(const Giesekus<dim>           &model,
                     const TimeStep                &step,
                     const std::vector<VectorType> &log_conformation,
                     const std::vector<VectorType> &old_log_conformation,
                     const VectorType              &convection);

    void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override;

  private:
    const Giesekus<dim>            model;
    const BdfCoefficients          bdf;
    const TwoLevelWeights          extrapolation;
    const double                   dt;
    const std::vector<VectorType> &log_conformation;
    const std::vector<VectorType> &old_log_conformation;
    const VectorType              &convection;
  };

} // namespace Catena

#endif

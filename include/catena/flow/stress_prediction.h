#ifndef catena_flow_stress_prediction_h
#define catena_flow_stress_prediction_h

#include <catena/base/time_history.h>
#include <catena/flow/stress_model.h>
#include <catena/mesh/point_tensors.h>
#include <catena/rheology/giesekus.h>

#include <vector>

namespace Catena
{
  /**
   * The viscoelastic stress predicted in terms of the new velocity gradient L
   * (D'Avino & Hulsen, J. Non-Newtonian Fluid Mech. 165 (2010) 1602),
   *
   *   sigma + p I = 2 beta D + G (c_p - I),   c_p = c + c',
   *
   * with c = exp(s), s linear in the elements, and a part c' that such a field
   * does not resolve. It is made by what the equation of the conformation
   * leaves at a point and forgotten in a time M, as a time-dependent subscale
   * (Codina, Principe, Guasch & Badia, Comput. Methods Appl. Mech. Engrg. 196
   * (2007) 2413),
   *
   *   dc'/dt + c'/M = L c + c L^T + f(c) - w.grad c - dc/dt,
   *
   * where d/dt follows a point of the mesh and w = u - u_mesh is the velocity
   * against it. Both together by BDF2, with the coefficients a,
   *
   *   c_p = -(a1 c^n + a2 c^(n-1))/a0 - (m/dt) (a1 c'^n + a2 c'^(n-1))
   *         + (dt/a0) [ L c^ + c^ L^T + f(c^) ] - m w^.grad c^
   *         - (dt/a0 - m) [ L^n c^n + c^n L^nT + f(c^n)
   *                         - (c^n - c^(n-1))/dt^n ],
   *
   *   m = (a0/dt + 1/M)^(-1),
   *
   * with ^ the extrapolation to the new instant, dt^n = t^n - t^(n-1), and L^n
   * the gradient of u^n on the mesh as it is at the new instant. This is of
   * second order in time; at rest in time c' = M r with the residual r, which
   * is of the order of the elements, whatever the step. The tensor viscosity is
   * H = beta I + (G dt/a0) c^, where c^ = exp(s^) stays positive: the momentum
   * balance is well posed also without solvent. With m = dt/a0 and c'^n =
   * c'^(n-1) = 0 it is the published scheme, in which the stress at rest
   * depends on the step.
   *
   * The shorter M is, the less the stress has of r. With
   *
   *   M = ( (1/lambda + 2)^2 + (|L^n|/2)^2 + (|w^|/4h)^2 )^(-1/2),
   *
   * in units of 1/gamma, with the length h of an element along w^, it is the
   * time in which the conformation relaxes, turns or is carried through four
   * elements. The numbers are those with which the spins of three aligned
   * particles and the force between them on 48 and 64 elements on an equator
   * are nearest to those on 128 (Wi = 3, alpha = beta = 0.1, a gap of 0.02
   * diameters).
   *
   * In a step without a previous one m = dt/a0.
   *
   * With little solvent, motions that the continuous P1 stress does not see are
   * held by the part with c^ alone. Then a numerical viscosity is added on
   * them, 2 theta (D - D_h^n) with the smooth rate of strain D_h^n of the last
   * instant (discrete elastic-viscous stress splitting, Guenette & Fortin, J.
   * Non-Newtonian Fluid Mech. 60 (1995) 27): first order in time, nothing at a
   * steady smooth flow.
   */
  template <int dim>
  class StressPrediction : public StressModel<dim>
  {
  public:
    using Cell = typename MovingMesh<dim>::Cell;

    /// The conformation at an instant, kept by reference: of fields that last
    /// as long as the prediction.
    struct Conformation
    {
      /// s
      const std::vector<VectorType> &logarithm;
      /// c'; none if it is zero
      const PointTensors<dim> &unresolved;
    };

    /// Motion of the fluid that the prediction takes as known. Not to be
    /// copied: fields lose their ghost values.
    struct Motion
    {
      /// w^ at the P2 nodes
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

    /// The part of c_p that is known before the velocity.
    using KnownConformation = PointTensors<dim, double>;

    /**
     * @param mesh kept by reference, as motion and storage are
     * @param now, before the conformation at t^n and t^(n-1)
     * @param motion see Motion
     * @param storage of this mesh. It is large: to ask for the memory in each
     * step would leave gaps in it.
     */
    StressPrediction(const MovingMesh<dim> &mesh,
                     const Giesekus<dim>   &model,
                     const TimeStep        &step,
                     const Conformation    &now,
                     const Conformation    &before,
                     const Motion          &motion,
                     KnownConformation     &storage);

    /// @param values with the rules of CellValues
    void
    evaluate(const Cell                           &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override;

    /**
     * c' = c_p - exp(s) at the new instant, with the velocity and the
     * log-conformation that were solved for. The stress has been evaluated in
     * all cells of this rank, on the mesh as it is.
     * @param result of this mesh, or empty
     */
    void
    unresolved_conformation(const VectorType              &velocity,
                            const std::vector<VectorType> &log_conformation,
                            PointTensors<dim>             &result) const;

  private:
    using Tensors    = dealii::SymmetricTensor<2, dim, Pack>;
    using PackValues = typename CellValues<dim>::PackValues;

    /// c_p = known + (dt/a0) (L c^ + c^ L^T)
    struct Prediction
    {
      Tensors known, c_hat;
    };

    /// What is known of a cell.
    struct CellData;

    const MovingMesh<dim> &mesh;
    const Giesekus<dim>    model;
    const TimeStep         step;
    const Conformation     now, before;
    const Motion          &motion;

    /// left by evaluate(): it takes long to compute
    KnownConformation &known_conformation;

    Prediction
    predict(const CellData        &data,
            const CellValues<dim> &values,
            const PackValues      &pack) const;

    Tensors
    unresolved_history(const CellData &data, const PackValues &pack) const;

    void
    add_numerical_viscosity(
      const Cell                           &cell,
      const CellValues<dim>                &values,
      std::vector<StressCoefficients<dim>> &coefficients) const;
  };

} // namespace Catena

#endif

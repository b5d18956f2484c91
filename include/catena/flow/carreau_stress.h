#ifndef catena_flow_carreau_stress_h
#define catena_flow_carreau_stress_h

#include <catena/flow/stress_model.h>
#include <catena/rheology/carreau.h>

#include <vector>

namespace Catena
{
  /**
   * How a nonlinear stress is replaced by an affine one: with the viscosity
   * frozen, or with its derivative.
   */
  enum class Linearisation
  {
    picard,
    newton
  };



  /**
   * The stress of a Carreau fluid linearised about a velocity u_k. With
   * B = D(u_k), eta and its derivative at g^2 = 2 B:B,
   *
   *   Picard:  sigma + p I = 2 eta D,
   *   Newton:  sigma + p I = 2 eta D + k (B:D - B:B) B,
   *            k = 8 d eta/d(g^2).
   *
   * Both are the exact stress at u_k. The tensors of the latter's derivative
   * have the viscosity eta in all directions but that of B, in which it is
   * eta + 2 g^2 d eta/d(g^2): between n eta and eta for n < 1.
   */
  template <int dim>
  class CarreauStress : public StressModel<dim>
  {
  public:
    /**
     * @param velocity u_k at the P2 nodes, kept by reference
     */
    CarreauStress(const Carreau      &model,
                  const VectorType   &velocity,
                  const Linearisation linearisation);

    bool
    has_scalar_viscosity() const override
    {
      return true;
    }

    bool
    has_tangent() const override
    {
      return linearisation == Linearisation::newton;
    }

    void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override;

  private:
    const Carreau       model;
    const VectorType   &velocity;
    const Linearisation linearisation;
  };
} // namespace Catena

#endif

#ifndef catena_flow_stress_model_h
#define catena_flow_stress_model_h

#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Catena
{
  /**
   * The extra stress at a point as an affine function of the velocity
   * gradient L that is being solved for,
   *
   *   sigma + p I = L H + H L^T + k (B:D) B + T,   D = (L + L^T)/2,
   *
   * with a tensor viscosity H, a known stress T and, for a viscosity
   * linearised in the rate of strain, a symmetric tensor B and a factor k; in
   * units of eta0 and eta0 gamma. A Newtonian fluid has H = I, T = 0; the
   * implicit stress of a viscoelastic one adds the conformation to H.
   */
  template <int dim>
  struct StressCoefficients
  {
    dealii::SymmetricTensor<2, dim> viscosity;
    dealii::SymmetricTensor<2, dim> known_stress;
    dealii::SymmetricTensor<2, dim> tangent;
    /// zero where has_tangent() is false
    double tangent_factor = 0.;

    dealii::SymmetricTensor<2, dim>
    stress(const dealii::Tensor<2, dim> &velocity_gradient) const
    {
      const dealii::Tensor<2, dim> product =
        velocity_gradient * dealii::Tensor<2, dim>(viscosity);
      dealii::SymmetricTensor<2, dim> result =
        2. * dealii::symmetrize(product) + known_stress;
      if (tangent_factor != 0.)
        result +=
          (tangent_factor * (tangent * dealii::symmetrize(velocity_gradient))) *
          tangent;
      return result;
    }
  };



  /**
   * Where the flow gets its stress from.
   */
  template <int dim>
  class StressModel
  {
  public:
    virtual ~StressModel() = default;

    /// Has it a factor k and a tensor B? One that has and does not say so is
    /// refused.
    virtual bool
    has_tangent() const
    {
      return false;
    }

    /// Is H a multiple of I? One that says so and has another is refused.
    virtual bool
    has_scalar_viscosity() const
    {
      return false;
    }

    /**
     * The coefficients at the quadrature points of a cell.
     * @param coefficients resized to the number of points
     */
    virtual void
    evaluate(const typename MovingMesh<dim>::Cell &cell,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const = 0;
  };



  /**
   * sigma = -p I + 2 D, in units of eta0.
   */
  template <int dim>
  class NewtonianStress : public StressModel<dim>
  {
  public:
    bool
    has_scalar_viscosity() const override
    {
      return true;
    }

    void
    evaluate(const typename MovingMesh<dim>::Cell &,
             const CellValues<dim>                &values,
             std::vector<StressCoefficients<dim>> &coefficients) const override
    {
      StressCoefficients<dim> newtonian;
      newtonian.viscosity = dealii::unit_symmetric_tensor<dim>();
      coefficients.assign(values.points().size(), newtonian);
    }
  };
} // namespace Catena

#endif

#include <catena/flow/carreau_stress.h>
#include <catena/mesh/cell_fields.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  CarreauStress<dim>::CarreauStress(const Carreau      &model,
                                    const VectorType   &velocity,
                                    const Linearisation linearisation)
    : model(model)
    , velocity(velocity)
    , linearisation(linearisation)
  {}



  template <int dim>
  void
  CarreauStress<dim>::evaluate(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const auto u = node_vectors<dim>(cell, velocity);
    coefficients.assign(values.points().size(), StressCoefficients<dim>());
    for (unsigned int q = 0; q < coefficients.size(); ++q)
      {
        const SymmetricTensor<2, dim> rate =
          symmetrize(gradient_at<dim>(values.points()[q], u));
        const double rate_squared = 2. * (rate * rate);

        StressCoefficients<dim> &c = coefficients[q];
        c.viscosity =
          model.viscosity(rate_squared) * unit_symmetric_tensor<dim>();
        if (linearisation == Linearisation::newton)
          {
            c.tangent        = rate;
            c.tangent_factor = 8. * model.viscosity_derivative(rate_squared);
            c.known_stress   = -c.tangent_factor * (rate * rate) * rate;
          }
      }
  }



  template class CarreauStress<2>;
  template class CarreauStress<3>;
} // namespace Catena

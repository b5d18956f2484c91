#include <catena/flow/carreau_stress.h>

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
    std::array<Tensor<1, dim>, MovingMesh<dim>::n_nodes> u;
    for (unsigned int a = 0; a < MovingMesh<dim>::n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        u[a][d] = velocity(dim * cell.nodes[a] + d);

    coefficients.assign(values.points().size(), StressCoefficients<dim>());
    for (unsigned int q = 0; q < coefficients.size(); ++q)
      {
        Tensor<2, dim> L;
        for (unsigned int a = 0; a < MovingMesh<dim>::n_nodes; ++a)
          L += outer_product(u[a], values.points()[q].quadratic_gradient[a]);
        const SymmetricTensor<2, dim> rate         = symmetrize(L);
        const double                  rate_squared = 2. * (rate * rate);

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

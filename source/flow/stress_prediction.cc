#include <catena/flow/stress_prediction.h>
#include <catena/rheology/spectral.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  StressPrediction<dim>::StressPrediction(
    const Giesekus<dim>           &model,
    const TimeStep                &step,
    const std::vector<VectorType> &log_conformation,
    const std::vector<VectorType> &old_log_conformation,
    const VectorType              &convection)
    : model(model)
    , bdf(step.bdf())
    , extrapolation(step.extrapolation())
    , dt(step.dt)
    , log_conformation(log_conformation)
    , old_log_conformation(old_log_conformation)
    , convection(convection)
  {}



  template <int dim>
  void
  StressPrediction<dim>::evaluate(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const auto s        = vertex_tensors<dim>(cell, log_conformation);
    const auto s_old    = vertex_tensors<dim>(cell, old_log_conformation);
    const auto identity = unit_symmetric_tensor<dim>();

    const double G = model.modulus(), beta = model.solvent_viscosity();
    coefficients.resize(values.points().size());
    for (unsigned int q = 0; q < coefficients.size(); ++q)
      {
        const auto             &point = values.points()[q];
        SymmetricTensor<2, dim> s_q, s_old_q, s_hat, s_hat_along_w;
        Tensor<1, dim>          w;
        for (unsigned int a = 0; a < MovingMesh<dim>::n_nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            w[d] += convection(dim * cell.nodes[a] + d) * point.quadratic[a];
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
          {
            s_q += point.linear[v] * s[v];
            s_old_q += point.linear[v] * s_old[v];
            s_hat_along_w +=
              (w * point.linear_gradient[v]) *
              (extrapolation.b0 * s[v] + extrapolation.b1 * s_old[v]);
          }
        s_hat = extrapolation.b0 * s_q + extrapolation.b1 * s_old_q;

        const auto spectrum = spectral_decomposition<dim>(s_hat);
        const SymmetricTensor<2, dim> c_hat = exponential<dim>(spectrum);
        SymmetricTensor<2, dim>       history =
          -bdf.a1 * exponential<dim>(spectral_decomposition<dim>(s_q));
        if (bdf.a2 != 0.)
          history -=
            bdf.a2 * exponential<dim>(spectral_decomposition<dim>(s_old_q));

        coefficients[q].viscosity = beta * identity + (G * dt / bdf.a0) * c_hat;
        coefficients[q].known_stress =
          (G / bdf.a0) *
            (history +
             dt * (model.relaxation(c_hat) -
                   exponential_derivative<dim>(spectrum, s_hat_along_w))) -
          G * identity;
      }
  }



  template class StressPrediction<2>;
  template class StressPrediction<3>;
} // namespace Catena

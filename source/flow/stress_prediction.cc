#include <catena/flow/stress_prediction.h>
#include <catena/rheology/spectral.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  double
  StressPrediction<dim>::numerical_viscosity(const Giesekus<dim> &model)
  {
    constexpr double enough = 0.1;
    return std::max(0., enough - model.solvent_viscosity());
  }



  template <int dim>
  StressPrediction<dim>::StressPrediction(
    const Giesekus<dim>           &model,
    const TimeStep                &step,
    const std::vector<VectorType> &log_conformation,
    const std::vector<VectorType> &old_log_conformation,
    const VectorType              &convection,
    const VectorType              &velocity,
    const VectorType              &old_convection,
    const std::vector<VectorType> &smooth_strain_rate)
    : model(model)
    , step(step)
    , log_conformation(log_conformation)
    , old_log_conformation(old_log_conformation)
    , convection(convection)
    , velocity(velocity)
    , old_convection(old_convection)
    , smooth_strain_rate(smooth_strain_rate)
  {}



  template <int dim>
  void
  StressPrediction<dim>::evaluate(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    constexpr unsigned int n_nodes       = MovingMesh<dim>::n_nodes;
    constexpr unsigned int n_vertices    = MovingMesh<dim>::n_vertices;
    const TwoLevelWeights  extrapolation = step.extrapolation();
    const bool             has_previous  = step.has_previous();
    const double           length =
      has_previous ? (step.dt + step.previous_dt) / 2. : step.dt;

    const auto s        = vertex_tensors<dim>(cell, log_conformation);
    const auto s_old    = vertex_tensors<dim>(cell, old_log_conformation);
    const auto identity = unit_symmetric_tensor<dim>();

    // at each point s^n, and in a step that has a previous one s^ and s^(n-1)
    const unsigned int                   n_points = values.points().size();
    std::vector<SymmetricTensor<2, dim>> tensors(has_previous ? 3 * n_points :
                                                                n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        SymmetricTensor<2, dim> s_q, s_old_q;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            s_q += values.points()[q].linear[v] * s[v];
            s_old_q += values.points()[q].linear[v] * s_old[v];
          }
        tensors[q] = s_q;
        if (has_previous)
          {
            tensors[n_points + q] =
              extrapolation.b0 * s_q + extrapolation.b1 * s_old_q;
            tensors[2 * n_points + q] = s_old_q;
          }
      }
    std::vector<SpectralDecomposition<dim>> spectra;
    spectral_decompositions(tensors, spectra);

    const double G = model.modulus(), beta = model.solvent_viscosity();
    coefficients.resize(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const auto    &point = values.points()[q];
        Tensor<1, dim> w_hat, w;
        Tensor<2, dim> L;
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int dof = dim * cell.nodes[a] + d;
              w_hat[d] += convection(dof) * point.quadratic[a];
              if (has_previous)
                {
                  w[d] += old_convection(dof) * point.quadratic[a];
                  L[d] += velocity(dof) * point.quadratic_gradient[a];
                }
            }
        SymmetricTensor<2, dim> s_hat_along_w, s_along_w;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            s_along_w += (w * point.linear_gradient[v]) * s[v];
            s_hat_along_w +=
              (w_hat * point.linear_gradient[v]) *
              (extrapolation.b0 * s[v] + extrapolation.b1 * s_old[v]);
          }

        const auto &spectrum = spectra[q];
        const auto &spectrum_hat =
          has_previous ? spectra[n_points + q] : spectrum;
        const auto c     = exponential<dim>(spectrum);
        const auto c_hat = exponential<dim>(spectrum_hat);

        SymmetricTensor<2, dim> predicted =
          c +
          length * (model.relaxation(c_hat) -
                    exponential_derivative<dim>(spectrum_hat, s_hat_along_w));
        if (has_previous)
          {
            const auto c_old = exponential<dim>(spectra[2 * n_points + q]);
            const auto rate  = model.relaxation(c) -
                              exponential_derivative<dim>(spectrum, s_along_w) +
                              2. * symmetrize(L * Tensor<2, dim>(c));
            predicted += step.ratio() * (c - c_old) - length * rate;
          }
        coefficients[q].viscosity    = beta * identity + (G * length) * c_hat;
        coefficients[q].known_stress = G * (predicted - identity);
      }
    if (!smooth_strain_rate.empty())
      add_numerical_viscosity(cell, values, coefficients);
  }



  template <int dim>
  void
  StressPrediction<dim>::add_numerical_viscosity(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const double theta = numerical_viscosity(model);
    const auto   rates = vertex_tensors<dim>(cell, smooth_strain_rate);
    for (unsigned int q = 0; q < coefficients.size(); ++q)
      {
        coefficients[q].viscosity += theta * unit_symmetric_tensor<dim>();
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
          coefficients[q].known_stress -=
            2. * theta * values.points()[q].linear[v] * rates[v];
      }
  }



  template class StressPrediction<2>;
  template class StressPrediction<3>;
} // namespace Catena

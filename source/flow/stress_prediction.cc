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
    const std::vector<VectorType> &smooth_strain_rate)
    : model(model)
    , step(step)
    , log_conformation(log_conformation)
    , old_log_conformation(old_log_conformation)
    , convection(convection)
    , smooth_strain_rate(smooth_strain_rate)
  {}



  template <int dim>
  void
  StressPrediction<dim>::evaluate(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const BdfCoefficients bdf           = step.bdf();
    const TwoLevelWeights extrapolation = step.extrapolation();
    const bool            has_previous  = step.has_previous();
    const auto            s = vertex_tensors<dim>(cell, log_conformation);
    const auto s_old        = vertex_tensors<dim>(cell, old_log_conformation);
    const auto convections  = node_vectors<dim>(cell, convection);
    const auto identity     = unit_symmetric_tensor<dim>();

    // at each point s^n, and in a step that has a previous one s^ and s^(n-1)
    const unsigned int                   n_points = values.points().size();
    std::vector<SymmetricTensor<2, dim>> tensors(has_previous ? 3 * n_points :
                                                                n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        SymmetricTensor<2, dim> s_q, s_old_q;
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
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
        const auto             &point = values.points()[q];
        const Tensor<1, dim>    w     = value_at<dim>(point, convections);
        SymmetricTensor<2, dim> s_hat_along_w;
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
          s_hat_along_w +=
            (w * point.linear_gradient[v]) *
            (extrapolation.b0 * s[v] + extrapolation.b1 * s_old[v]);

        const auto &spectrum =
          has_previous ? spectra[n_points + q] : spectra[q];
        const SymmetricTensor<2, dim> c_hat = exponential<dim>(spectrum);
        SymmetricTensor<2, dim>       history =
          -bdf.a1 * exponential<dim>(spectra[q]);
        if (has_previous)
          history -= bdf.a2 * exponential<dim>(spectra[2 * n_points + q]);

        coefficients[q].viscosity =
          beta * identity + (G * step.dt / bdf.a0) * c_hat;
        coefficients[q].known_stress =
          (G / bdf.a0) *
            (history +
             step.dt * (model.relaxation(c_hat) -
                        exponential_derivative<dim>(spectrum, s_hat_along_w))) -
          G * identity;
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

#include <catena/flow/stress_prediction.h>
#include <catena/rheology/exponentials.h>
#include <catena/rheology/spectral.h>

#include <algorithm>

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
    const Motion                  &motion)
    : model(model)
    , step(step)
    , log_conformation(log_conformation)
    , old_log_conformation(old_log_conformation)
    , motion(motion)
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
    const auto identity     = unit_symmetric_tensor<dim>();
    const auto convections  = node_vectors<dim>(cell, motion.convection);
    const auto u_last       = node_vectors<dim>(cell, motion.last_velocity);

    const unsigned int                   n_points = values.points().size();
    std::vector<SymmetricTensor<2, dim>> s_now(n_points), s_before(n_points),
      s_hat(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
          {
            s_now[q] += values.points()[q].linear[v] * s[v];
            s_before[q] += values.points()[q].linear[v] * s_old[v];
          }
        s_hat[q] = extrapolation.b0 * s_now[q] + extrapolation.b1 * s_before[q];
      }
    std::vector<SymmetricTensor<2, dim>> c_now, c_before, c_hat;
    exponentials(s_now, c_now);
    if (has_previous)
      exponentials(s_before, c_before);
    exponentials(s_hat, c_hat);
    std::vector<SpectralDecomposition<dim>> spectra_hat;
    spectral_decompositions(s_hat, spectra_hat);

    const double G = model.modulus(), beta = model.solvent_viscosity();
    const double implicit_time = step.dt / bdf.a0;
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

        SymmetricTensor<2, dim> known =
          -bdf.a1 / bdf.a0 * c_now[q] +
          implicit_time * model.relaxation(c_hat[q]);
        double memory = implicit_time;
        if (has_previous)
          {
            known -= bdf.a2 / bdf.a0 * c_before[q];
            const Tensor<2, dim> L = gradient_at<dim>(point, u_last);
            memory =
              std::min(memory,
                       model.time_of_change(L,
                                            crossing_rate<dim>(point, w) / 4.));
            if (memory < implicit_time)
              known -= (implicit_time - memory) *
                       (model.conformation_rate(L, c_now[q]) -
                        (1. / step.previous_dt) * (c_now[q] - c_before[q]));
          }
        known -=
          memory * exponential_derivative<dim>(spectra_hat[q], s_hat_along_w);

        coefficients[q].viscosity =
          beta * identity + (G * implicit_time) * c_hat[q];
        coefficients[q].known_stress = G * (known - identity);
      }
    if (!motion.smooth_strain_rate.empty())
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
    const auto   rates = vertex_tensors<dim>(cell, motion.smooth_strain_rate);
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

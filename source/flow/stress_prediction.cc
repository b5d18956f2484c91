#include <catena/flow/stress_prediction.h>
#include <catena/rheology/exponentials.h>
#include <catena/rheology/spectral.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// by the fluid, in the time in which the prediction forgets
    constexpr double n_crossed_elements = 2.;
  } // namespace



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

    // at each point s^, s^n and, in a step that has a previous one, s^(n-1)
    const unsigned int                   n_points = values.points().size();
    std::vector<SymmetricTensor<2, dim>> s_hat(n_points),
      tensors(has_previous ? 3 * n_points : 2 * n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        SymmetricTensor<2, dim> s_now, s_before;
        for (unsigned int v = 0; v < MovingMesh<dim>::n_vertices; ++v)
          {
            s_now += values.points()[q].linear[v] * s[v];
            s_before += values.points()[q].linear[v] * s_old[v];
          }
        s_hat[q]   = extrapolation.b0 * s_now + extrapolation.b1 * s_before;
        tensors[q] = s_hat[q];
        tensors[n_points + q] = s_now;
        if (has_previous)
          tensors[2 * n_points + q] = s_before;
      }
    std::vector<SymmetricTensor<2, dim>> c;
    exponentials(tensors, c);
    std::vector<SpectralDecomposition<dim>> spectra;
    spectral_decompositions(s_hat, spectra);

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

        const SymmetricTensor<2, dim> &c_hat = c[q], &c_now = c[n_points + q];
        SymmetricTensor<2, dim>        known =
          -bdf.a1 / bdf.a0 * c_now + implicit_time * model.relaxation(c_hat);
        double memory = implicit_time;
        if (has_previous)
          {
            const SymmetricTensor<2, dim> &c_before = c[2 * n_points + q];
            known -= bdf.a2 / bdf.a0 * c_before;

            const Tensor<2, dim> L = gradient_at<dim>(point, u_last);
            const double         crossing =
              crossing_rate<dim>(point, w) / (2. * n_crossed_elements);
            memory = std::min(memory, model.time_of_change(L, crossing));
            if (memory < implicit_time)
              known -= (implicit_time - memory) *
                       (model.conformation_rate(L, c_now) -
                        (1. / step.previous_dt) * (c_now - c_before));
          }
        known -=
          memory * exponential_derivative<dim>(spectra[q], s_hat_along_w);

        coefficients[q].viscosity =
          beta * identity + (G * implicit_time) * c_hat;
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

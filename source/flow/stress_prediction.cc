#include <catena/flow/stress_prediction.h>
#include <catena/rheology/exponential.h>

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
    using Tensors = SymmetricTensor<2, dim, Pack>;

    const BdfCoefficients bdf           = step.bdf();
    const TwoLevelWeights extrapolation = step.extrapolation();
    const double          implicit_time = step.dt / bdf.a0;
    const double          G = model.modulus(), beta = model.solvent_viscosity();
    const auto            identity = unit_symmetric_tensor<dim, Pack>();
    const auto            s = vertex_tensors<dim>(cell, log_conformation);
    const auto s_old        = vertex_tensors<dim>(cell, old_log_conformation);
    const auto convections  = node_vectors<dim>(cell, motion.convection);
    const auto u_last       = node_vectors<dim>(cell, motion.last_velocity);

    auto s_extrapolated = s;
    for (unsigned int v = 0; v < s.size(); ++v)
      s_extrapolated[v] = extrapolation.b0 * s[v] + extrapolation.b1 * s_old[v];

    coefficients.resize(values.points().size());
    for (const auto &pack : values.packs())
      {
        const auto w = values_at<dim>(values, pack, convections);
        // the other of the two is (w . grad) c^
        const auto [c_hat, c_hat_along_w] =
          exponential(interpolate<dim>(pack, s_extrapolated),
                      derivative_along<dim>(pack, w, s_extrapolated));
        const Tensors c_now = exponential(interpolate<dim>(pack, s));

        Tensors known =
          (-bdf.a1 / bdf.a0) * c_now + implicit_time * model.relaxation(c_hat);
        Pack memory = implicit_time;
        if (step.has_previous())
          {
            const Tensors c_before = exponential(interpolate<dim>(pack, s_old));
            known -= (bdf.a2 / bdf.a0) * c_before;

            const auto L = gradients_at<dim>(values, pack, u_last);
            const Pack crossing =
              crossing_rate<dim>(pack, w) / (2. * n_crossed_elements);
            memory = min(memory, model.time_of_change(L, crossing));
            if (any_of(memory < implicit_time))
              known -= (implicit_time - memory) *
                       (model.conformation_rate(L, c_now) -
                        (1. / step.previous_dt) * (c_now - c_before));
          }
        known -= memory * c_hat_along_w;

        const Tensors viscosity = beta * identity + (G * implicit_time) * c_hat,
                      stress    = G * (known - identity);
        for (unsigned int k = 0; k < pack.n_points; ++k)
          {
            coefficients[pack.first + k].viscosity    = lane<dim>(viscosity, k);
            coefficients[pack.first + k].known_stress = lane<dim>(stress, k);
          }
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

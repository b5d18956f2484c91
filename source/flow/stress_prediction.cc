#include <catena/flow/stress_prediction.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/exponential.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// In M: a rate, in units of gamma, the share of |L|, and the elements that
    /// are crossed.
    constexpr double least_rate = 2., gradient_share = 0.5,
                     n_crossed_elements = 4.;

    /// M at the points of a pack, in units of 1/gamma.
    template <int dim>
    Pack
    memory_time(const Giesekus<dim>                        &model,
                const typename CellValues<dim>::PackValues &pack,
                const Tensor<1, dim, Pack>                 &w,
                const Tensor<2, dim, Pack>                 &L)
    {
      const double relaxing = 1. / model.relaxation_time() + least_rate;
      const Pack   turning  = gradient_share * frobenius_norm(L);
      const Pack   crossing =
        crossing_rate<dim>(pack, w) / (2. * n_crossed_elements);
      return 1. / sqrt(relaxing * relaxing + turning * turning +
                       crossing * crossing);
    }
  } // namespace



  template <int dim>
  struct StressPrediction<dim>::CellData
  {
    using VertexTensors =
      std::array<SymmetricTensor<2, dim>, n_linear_nodes(dim)>;

    const Cell      &cell;
    VertexTensors    s, s_old, s_extrapolated;
    NodeVectors<dim> convection, last_velocity;

    CellData(const Cell &cell, const StressPrediction &prediction)
      : cell(cell)
      , s(vertex_tensors<dim>(cell, prediction.now.logarithm))
      , s_old(vertex_tensors<dim>(cell, prediction.before.logarithm))
      , convection(node_vectors<dim>(cell, prediction.motion.convection))
      , last_velocity(node_vectors<dim>(cell, prediction.motion.last_velocity))
    {
      const TwoLevelWeights weights = prediction.step.extrapolation();
      for (unsigned int v = 0; v < s.size(); ++v)
        s_extrapolated[v] = weights.b0 * s[v] + weights.b1 * s_old[v];
    }
  };



  template <int dim>
  double
  StressPrediction<dim>::numerical_viscosity(const Giesekus<dim> &model)
  {
    constexpr double enough = 0.1;
    return std::max(0., enough - model.solvent_viscosity());
  }



  template <int dim>
  StressPrediction<dim>::StressPrediction(const MovingMesh<dim> &mesh,
                                          const Giesekus<dim>   &model,
                                          const TimeStep        &step,
                                          const Conformation    &now,
                                          const Conformation    &before,
                                          const Motion          &motion,
                                          KnownConformation     &storage)
    : mesh(mesh)
    , model(model)
    , step(step)
    , now(now)
    , before(before)
    , motion(motion)
    , known_conformation(storage)
  {}



  template <int dim>
  typename StressPrediction<dim>::Prediction
  StressPrediction<dim>::predict(const CellData        &data,
                                 const CellValues<dim> &values,
                                 const PackValues      &pack) const
  {
    const BdfCoefficients bdf           = step.bdf();
    const double          implicit_time = step.dt / bdf.a0;
    const auto            w = values_at<dim>(values, pack, data.convection);
    // the other of the two is (w . grad) c^
    const auto [c_hat, c_hat_along_w] =
      exponential(interpolate<dim>(pack, data.s_extrapolated),
                  derivative_along<dim>(pack, w, data.s_extrapolated));
    const Tensors c_now = exponential(interpolate<dim>(pack, data.s));

    Tensors known =
      (-bdf.a1 / bdf.a0) * c_now + implicit_time * model.relaxation(c_hat);
    if (!step.has_previous())
      {
        known += unresolved_history(data, pack);
        known -= implicit_time * c_hat_along_w;
        return {known, c_hat};
      }

    const Tensors c_before = exponential(interpolate<dim>(pack, data.s_old));
    const auto    L = gradients_at<dim>(values, pack, data.last_velocity);
    const Pack    M = memory_time(model, pack, w, L),
               m    = 1. / (1. / implicit_time + 1. / M);
    const Tensors remaining = model.conformation_rate(L, c_now) -
                              (1. / step.previous_dt) * (c_now - c_before);

    known -= (bdf.a2 / bdf.a0) * c_before;
    known -= m * c_hat_along_w;
    known -= (implicit_time - m) * remaining;
    known += (m / implicit_time) * unresolved_history(data, pack);
    return {known, c_hat};
  }



  /// -(a1 c'^n + a2 c'^(n-1))/a0
  template <int dim>
  typename StressPrediction<dim>::Tensors
  StressPrediction<dim>::unresolved_history(const CellData   &data,
                                            const PackValues &pack) const
  {
    const BdfCoefficients bdf = step.bdf();
    Tensors               history;
    // the viscosity, all that is needed of other cells, does not depend on it
    if (!data.cell.owned)
      return history;
    if (!now.unresolved.empty())
      history = (-bdf.a1 / bdf.a0) * now.unresolved.get(data.cell, pack);
    if (!before.unresolved.empty())
      history -= (bdf.a2 / bdf.a0) * before.unresolved.get(data.cell, pack);
    return history;
  }



  template <int dim>
  void
  StressPrediction<dim>::evaluate(
    const Cell                           &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const double   G = model.modulus(), beta = model.solvent_viscosity();
    const double   implicit_time = step.dt / step.bdf().a0;
    const auto     identity      = unit_symmetric_tensor<dim, Pack>();
    const CellData data(cell, *this);

    coefficients.resize(values.points().size());
    for (const auto &pack : values.packs())
      {
        const auto [known, c_hat] = predict(data, values, pack);
        if (cell.owned)
          known_conformation.set(cell, pack, known);
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
  StressPrediction<dim>::unresolved_conformation(
    const VectorType              &velocity,
    const std::vector<VectorType> &log_conformation,
    PointTensors<dim>             &result) const
  {
    if (result.empty())
      result = PointTensors<dim>(mesh);
    const double    implicit_time = step.dt / step.bdf().a0;
    CellValues<dim> values;
    for (const Cell &cell : mesh.cells())
      {
        if (!cell.owned)
          continue;
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        const CellData data(cell, *this);
        const auto     u = node_vectors<dim>(cell, velocity);
        const auto     s = vertex_tensors<dim>(cell, log_conformation);
        for (const auto &pack : values.packs())
          {
            const auto L = gradients_at<dim>(values, pack, u);
            const auto c_hat =
              exponential(interpolate<dim>(pack, data.s_extrapolated));
            const Tensors c_p = known_conformation.get(cell, pack) +
                                implicit_time * stretching_rate(L, c_hat);
            result.set(cell,
                       pack,
                       c_p - exponential(interpolate<dim>(pack, s)));
          }
      }
  }



  template <int dim>
  void
  StressPrediction<dim>::add_numerical_viscosity(
    const Cell                           &cell,
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

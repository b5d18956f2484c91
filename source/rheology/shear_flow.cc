#include <catena/base/exceptions.h>
#include <catena/base/types.h>
#include <catena/rheology/shear_flow.h>

#include <boost/numeric/odeint.hpp>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  SteadyShear
  steady_shear(const GiesekusParameters &parameters)
  {
    parameters.check();
    const double Wi    = parameters.weissenberg_number;
    const double alpha = parameters.mobility_parameter;
    const double beta  = parameters.solvent_viscosity_ratio;

    // Multiplying f out by the factors that vanish with alpha, 1 - alpha and
    // Wi gives f = alpha k/(Lambda + alpha k), in which nothing cancels.
    const double root   = std::sqrt(1. + 16. * alpha * (1. - alpha) * Wi * Wi);
    const double Lambda = std::sqrt(2. / (1. + root));
    const double k = 8. * Wi * Wi / ((1. + root) * (1. + root) * (1. + Lambda));
    const double f = alpha * k / (Lambda + alpha * k);
    const double remainder   = Lambda / (Lambda + alpha * k); // 1 - f
    const double denominator = remainder + 2. * (1. - alpha) * f;

    SteadyShear state;
    state.shear_stress = Wi * remainder * remainder / denominator;
    state.first_normal_stress_difference =
      2. * k * (remainder + (1. - alpha) * f) / Lambda;
    state.second_normal_stress_difference = 0. - f; // 0, not -0

    const double modulus = (1. - beta) / Wi;
    state.viscosity      = beta + modulus * state.shear_stress;
    state.elasticity_parameter =
      modulus * state.first_normal_stress_difference / (2. * state.viscosity);
    return state;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  SteadyShear::conformation() const
  {
    SymmetricTensor<2, dim> c = unit_symmetric_tensor<dim>();
    c[1][1] += second_normal_stress_difference;
    c[0][0] = c[1][1] + first_normal_stress_difference;
    c[0][1] = shear_stress;
    return c;
  }



  namespace
  {
    /// The independent components of s in deal.II's order.
    template <int dim>
    using LogConformation = std::array<double, n_symmetric_components(dim)>;

    template <int dim>
    SymmetricTensor<2, dim>
    to_tensor(const LogConformation<dim> &components)
    {
      SymmetricTensor<2, dim> s;
      for (unsigned int k = 0; k < components.size(); ++k)
        s.access_raw_entry(k) = components[k];
      return s;
    }
  } // namespace



  template <int dim>
  std::vector<SymmetricTensor<2, dim>>
  start_up(const Giesekus<dim>       &model,
           const Tensor<2, dim>      &L,
           const std::vector<double> &times)
  {
    namespace odeint = boost::numeric::odeint;

    double previous = 0.;
    for (const double time : times)
      {
        require(time >= previous && std::isfinite(time),
                "times",
                time,
                "times of a start-up must be finite, not negative and not "
                "decreasing.");
        previous = time;
      }

    const auto rate = [&](const LogConformation<dim> &s,
                          LogConformation<dim>       &ds_dt,
                          const double /*time*/) {
      const SymmetricTensor<2, dim> g =
        model.log_conformation_rate(L,
                                    spectral_decomposition(to_tensor<dim>(s)));
      for (unsigned int k = 0; k < ds_dt.size(); ++k)
        ds_dt[k] = g.access_raw_entry(k);
    };

    std::vector<SymmetricTensor<2, dim>> result;
    const auto observe = [&](const LogConformation<dim> &s,
                             const double /*time*/) {
      result.push_back(exponential(spectral_decomposition(to_tensor<dim>(s))));
      if (!std::isfinite(result.back().norm()))
        throw SolverError("The start-up flow gives a conformation that is not "
                          "finite: use a smaller velocity gradient.");
    };

    // In weak flow s is of the size of lambda |L|.
    constexpr double tolerance = 1e-12;
    const double     gradient  = 1e-100 + L.norm();
    const double     size = std::min(1., model.relaxation_time() * gradient);
    const double     first_step =
      1e-3 * std::min(model.relaxation_time(), 1. / gradient);

    std::vector<double> stops = {0.};
    stops.insert(stops.end(), times.begin(), times.end());

    LogConformation<dim> s{};
    odeint::integrate_times(
      odeint::make_controlled<
        odeint::runge_kutta_fehlberg78<LogConformation<dim>>>(tolerance * size,
                                                              tolerance),
      rate,
      s,
      stops.begin(),
      stops.end(),
      first_step,
      observe);

    // The first state is the rest that the flow starts from.
    result.erase(result.begin());
    return result;
  }



  template SymmetricTensor<2, 2>
  SteadyShear::conformation() const;
  template SymmetricTensor<2, 3>
  SteadyShear::conformation() const;

  template std::vector<SymmetricTensor<2, 2>>
  start_up(const Giesekus<2> &,
           const Tensor<2, 2> &,
           const std::vector<double> &);
  template std::vector<SymmetricTensor<2, 3>>
  start_up(const Giesekus<3> &,
           const Tensor<2, 3> &,
           const std::vector<double> &);
} // namespace Catena

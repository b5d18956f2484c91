// The finite-element simulation of a box without particles is homogeneous
// shear of a Giesekus fluid from rest: its start-up meets the solution of the
// ordinary differential equation, with errors of second order in the time step
// and to 1e-8 when they are extrapolated, and its steady state the closed form.
// Our shear is u_x = -y, the references' u_x = +y: c_xy changes sign.

#include <catena/conformation/strain_rate_projection.h>
#include <catena/flow/stress_prediction.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/shear_flow.h>
#include <catena/simulation/simulation.h>

#include <string>

#include "../tests.h"

#include "../print.h"

using namespace Catena;
using namespace Catena::Tests;

template <int dim>
Scene<dim>
small_box(const Symmetry symmetry)
{
  Scene<dim> scene;
  scene.length = scene.height = scene.width = 2.;
  scene.symmetry                            = symmetry;
  return scene;
}



SimulationParameters
make_parameters(const GiesekusParameters &fluid, const double dt)
{
  SimulationParameters parameters;
  parameters.fluid.giesekus                = fluid;
  parameters.step_control.time_step        = dt;
  parameters.mesh.maximal_size             = 1.;
  parameters.flow_solver.tolerance         = 1e-8;
  parameters.conformation_solver.tolerance = 1e-13;
  return parameters;
}



/// The state of a fluid in homogeneous flow, as the simulation has it.
template <int dim>
struct Homogeneous
{
  dealii::SymmetricTensor<2, dim> conformation;
  dealii::SymmetricTensor<2, dim> stress;      ///< of the next step
  double                          spread;      ///< of s over the vertices
  double                          disturbance; ///< of velocity and pressure
};



/// The state a time @p duration after the start.
template <int dim>
Homogeneous<dim>
simulate(const Scene<dim>         &scene,
         const GiesekusParameters &fluid,
         const double              dt,
         const double              duration)
{
  SimulationParameters parameters = make_parameters(fluid, dt);
  parameters.final_strain         = duration;
  Simulation<dim> simulation(scene, parameters, MPI_COMM_SELF);
  simulation.initialize();
  StepReport report;
  while (simulation.strain() - simulation.initial_strain() < duration - 1e-9)
    report = simulation.advance();

  const MovingMesh<dim>          &mesh  = simulation.mesh();
  const State<dim>               &state = simulation.current_state();
  const auto                     &s     = state.now.log_conformation;
  Homogeneous<dim>                result;
  dealii::SymmetricTensor<2, dim> s_0;
  result.spread = 0.;
  for (unsigned int k = 0; k < s.size(); ++k)
    {
      s_0.access_raw_entry(k) = s[k](0);
      for (const auto vertex : mesh.owned_scalars())
        result.spread =
          std::max(result.spread, std::abs(s[k](vertex) - s[k](0)));
    }
  result.conformation = exponential<dim>(spectral_decomposition<dim>(s_0));

  result.disturbance = state.now.flow.pressure.linfty_norm();
  for (const auto node : mesh.owned_nodes())
    {
      const auto x = node_position<dim>(mesh.positions(), node);
      for (unsigned int d = 0; d < dim; ++d)
        result.disturbance =
          std::max(result.disturbance,
                   std::abs(state.now.flow.velocity(dim * node + d) -
                            scene.imposed_velocity(x)[d]));
    }

  // what the flow of the next step takes for the stress
  typename StressPrediction<dim>::Motion motion;
  motion.convection    = state.now.flow.velocity;
  motion.last_velocity = state.now.flow.velocity;
  if (StressPrediction<dim>::numerical_viscosity(Giesekus<dim>(fluid)) > 0.)
    motion.smooth_strain_rate =
      StrainRateProjection<dim>(mesh).project(state.now.flow.velocity);
  typename StressPrediction<dim>::KnownConformation storage(mesh);
  const StressPrediction<dim>                       prediction(mesh,
                                         Giesekus<dim>(fluid),
                                         {report.dt, report.dt},
                                         {s, state.now.unresolved_conformation},
                                         {state.before.log_conformation,
                                                                state.before.unresolved_conformation},
                                         motion,
                                         storage);
  std::vector<StressCoefficients<dim>>              coefficients;
  CellValues<dim>                                   values;
  const auto                                       &cell = mesh.cells().front();
  values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
  prediction.evaluate(cell, values, coefficients);
  result.stress = coefficients.front().stress(scene.imposed_gradient());
  return result;
}



GiesekusParameters
make_fluid(const double Wi, const double alpha, const double beta)
{
  GiesekusParameters fluid;
  fluid.weissenberg_number      = Wi;
  fluid.mobility_parameter      = alpha;
  fluid.solvent_viscosity_ratio = beta;
  return fluid;
}



/// The row of a table with these values in these columns.
unsigned int
find_row(const Table &table, const std::map<std::string, double> &values)
{
  for (unsigned int row = 0; row < table.n_rows; ++row)
    {
      bool found = true;
      for (const auto &value : values)
        found &= table[value.first][row] == value.second;
      if (found)
        return row;
    }
  throw std::runtime_error("The table has no such row.");
}



template <int dim>
void
check_steady_state(Claims            &claims,
                   const std::string &name,
                   const Scene<dim>  &scene,
                   const double       Wi,
                   const double       alpha,
                   const double       beta)
{
  const auto table = read_table("giesekus_simple_shear.csv");
  const auto row =
    find_row(table, {{"Wi", Wi}, {"alpha", alpha}, {"beta", beta}});
  const auto  state = simulate(scene,
                              make_fluid(Wi, alpha, beta),
                              std::min(0.1 * Wi, 0.2),
                              25. * Wi);
  const auto &c     = state.conformation;

  const auto compare =
    [&](const std::string &what, const double value, const double expected) {
      claims.near(name + ", " + what, value / expected, 1., 1e-8);
    };
  compare("shear stress of the polymer",
          -c[0][1],
          table["tauxy_p_over_G"][row]);
  compare("first normal stress difference",
          c[0][0] - c[1][1],
          table["N1_over_G"][row]);
  compare("second normal stress difference",
          c[1][1] - 1.,
          table["N2_over_G"][row]);
  compare("shear stress in the flow",
          -state.stress[0][1],
          table["eta_over_eta0"][row]);
  claims.at_most(name + ", homogeneous", state.spread, 1e-9);
  claims.at_most(name + ", no disturbance of the flow",
                 state.disturbance,
                 1e-9);
}



template <int dim>
void
check_start_up(Claims            &claims,
               const std::string &name,
               const Scene<dim>  &scene,
               const double       Wi,
               const double       strain)
{
  const double alpha = 0.1;
  const auto   table = read_table("giesekus_startup.csv");
  const auto   row =
    find_row(table, {{"Wi", Wi}, {"alpha", alpha}, {"strain", strain}});
  dealii::SymmetricTensor<2, dim> exact = dealii::unit_symmetric_tensor<dim>();
  exact[0][0]                           = table["cxx"][row];
  exact[0][1]                           = -table["cxy"][row];
  exact[1][1]                           = table["cyy"][row];

  // the errors, by the number of times they have been extrapolated
  std::vector<std::vector<dealii::SymmetricTensor<2, dim>>> errors(4);
  for (const double dt : {0.05, 0.025, 0.0125, 0.00625})
    {
      const auto state =
        simulate(scene, make_fluid(Wi, alpha, 0.1), dt, strain);
      errors[0].push_back(state.conformation - exact);
      print(name,
            ": dt ",
            dt,
            ", error ",
            errors[0].back().norm(),
            ", spread ",
            state.spread,
            ", disturbance ",
            state.disturbance);
    }
  for (unsigned int k = 1; k < errors.size(); ++k)
    for (unsigned int i = 1; i < errors[k - 1].size(); ++i)
      {
        const double weight = std::pow(2., k + 1);
        errors[k].push_back((weight * errors[k - 1][i] - errors[k - 1][i - 1]) /
                            (weight - 1.));
      }
  claims.near(name + ", second order in the time step",
              std::log2(errors[0][2].norm() / errors[0][3].norm()),
              2.,
              0.05);
  claims.at_most(name + ", extrapolated to the exact conformation",
                 errors.back().back().norm(),
                 1e-8);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const auto plane         = small_box<2>(Symmetry::none);
    const auto plane_quarter = small_box<2>(Symmetry::quarter);
    const auto quarter       = small_box<3>(Symmetry::quarter);

    check_steady_state<2>(
      claims, "dim 2, steady, Wi 0.5", plane_quarter, 0.5, 0.1, 0.6);
    check_steady_state<2>(claims, "dim 2, steady, Wi 8", plane, 8., 0.1, 0.1);
    check_steady_state<3>(claims, "dim 3, steady, Wi 1", quarter, 1., 0.1, 0.1);

    check_start_up<2>(claims, "dim 2, start-up, Wi 1", plane, 1., 2.);
    check_start_up<2>(claims, "dim 2, start-up, Wi 3", plane_quarter, 3., 3.);
    check_start_up<3>(claims, "dim 3, start-up, Wi 1", quarter, 1., 2.);
  });
}

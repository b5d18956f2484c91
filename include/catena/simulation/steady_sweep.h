#ifndef catena_simulation_steady_sweep_h
#define catena_simulation_steady_sweep_h

#include <catena/simulation/simulation.h>

#include <functional>
#include <string>
#include <vector>

namespace Catena
{
  /**
   * A number of a flow that becomes steady.
   */
  template <int dim>
  struct SteadyQuantity
  {
    /// of the table, without ".csv"
    std::string table;
    /// of the column, and its unit
    std::string name, unit;
    /// Its value now.
    std::function<double(const Simulation<dim> &)> value;
  };

  /// omega_z of the first particle [gamma].
  template <int dim>
  SteadyQuantity<dim>
  rotation_rate();

  /// K = F_x/(eta0 U), with F_x the force of the fluid on the first particle,
  /// which is fixed; for dim = 2 per length.
  template <int dim>
  SteadyQuantity<dim>
  drag_coefficient();



  /**
   * What a run to the steady state came to.
   */
  struct SteadyResult
  {
    double value = 0.;
    /// largest difference of the values over the last 1 + 2 Wi of strain
    double change = 0.;
    /// is the change below the tolerance?
    bool steady = true;
    /// strain at which the run ended
    double               strain = 0.;
    unsigned int         steps = 0, elements = 0, unknowns = 0;
    ConformationExtremes extremes;
  };

  /**
   * Run @p scene from rest until @p quantity has changed by less than
   * @p tolerance over the last two relaxation times and one unit of strain, or
   * to the final strain. Particles must not move from their places. Without a
   * conformation the flow is steady at once.
   *
   * @param path of a table with a row for each step
   */
  template <int dim>
  SteadyResult
  run_to_steady_state(const Scene<dim>           &scene,
                      const SimulationParameters &parameters,
                      const SteadyQuantity<dim>  &quantity,
                      const double                tolerance,
                      const std::string          &path,
                      const MPI_Comm              communicator);



  /**
   * Runs to the steady state at a number of rates.
   */
  struct SteadySweepParameters
  {
    /// Wi, or lambda_c gamma of a Carreau fluid; 0: Newtonian; none: as the
    /// fluid has it
    std::vector<double> rates;
    /// steady when the quantity has changed by less over 1 + 2 Wi of strain
    double tolerance = 1e-5;

    /// In a subsection `Sweep`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError
    void
    check(const SimulationParameters &simulation) const;
  };

  /**
   * Write the table of @p quantity in @p directory with a row for each rate,
   * and `trajectory_RATE.csv` with the steps of its run.
   */
  template <int dim>
  void
  steady_sweep(const Scene<dim>            &scene,
               const SimulationParameters  &parameters,
               const SteadySweepParameters &sweep,
               const SteadyQuantity<dim>   &quantity,
               const std::string           &directory,
               const MPI_Comm               communicator);
} // namespace Catena

#endif

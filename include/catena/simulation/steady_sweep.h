#ifndef catena_simulation_steady_sweep_h
#define catena_simulation_steady_sweep_h

#include <catena/simulation/run.h>

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
   * The steady state: a quantity has changed by less than a tolerance over the
   * last two relaxation times and one unit of strain. Without a conformation
   * the flow is steady at once.
   */
  template <int dim>
  class SteadyState : public Ending<dim>
  {
  public:
    SteadyState(const SimulationParameters &parameters,
                const SteadyQuantity<dim>  &quantity,
                const double                tolerance);

    bool
    reached(const Simulation<dim> &simulation, const StepReport &step) override;

    void
    archive(Archive &archive) override;

    /// What the run came to, after it was asked for its end.
    struct Result
    {
      double value = 0.;
      /// largest difference of the values over the last 1 + 2 Wi of strain
      double change = 0.;
      /// is the change below the tolerance?
      bool steady = false;
      /// strain at which the run ended
      double       strain = 0.;
      unsigned int steps = 0, elements = 0, unknowns = 0;
      /// wall time, also of the runs that were resumed
      double               seconds = 0.;
      ConformationExtremes extremes;
    };

    const Result &
    result() const
    {
      return last;
    }

  private:
    const SteadyQuantity<dim> quantity;
    const double              tolerance, window;
    const bool                steady_at_once;
    const double              begin; ///< on the clock
    double                    earlier_seconds = 0.;

    /// over the window
    std::vector<double> strains, values;
    Result              last;

    void
    add(const double strain, const double value);

    double
    change() const;
  };



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
   * Write the table of @p quantity in the directory of @p options with a row
   * for each rate, and in `rate_RATE` what run_simulation() writes. Particles
   * must not move from their places. A sweep that is resumed goes on with the
   * run that was not finished.
   *
   * @throws what run_simulation() throws
   */
  template <int dim>
  void
  steady_sweep(const Scene<dim>            &scene,
               const SimulationParameters  &parameters,
               const SteadySweepParameters &sweep,
               const SteadyQuantity<dim>   &quantity,
               const RunOptions            &options,
               const MPI_Comm               communicator);
} // namespace Catena

#endif

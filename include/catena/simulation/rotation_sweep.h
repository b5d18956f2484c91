#ifndef catena_simulation_rotation_sweep_h
#define catena_simulation_rotation_sweep_h

#include <catena/simulation/simulation.h>

#include <string>
#include <vector>

namespace Catena
{
  /**
   * How a particle turns when its angular velocity has become steady.
   */
  struct SteadyRotation
  {
    /// omega_z of the first particle [gamma]
    double angular_velocity = 0.;
    /// largest difference of its values over the last 1 + 2 Wi of strain
    /// [gamma]
    double change = 0.;
    /// strain at which the run ended
    double       strain   = 0.;
    unsigned int steps    = 0;
    unsigned int elements = 0;
  };

  /**
   * Run @p scene from rest until the angular velocity of its first particle
   * has changed by less than @p tolerance over the last two relaxation times
   * and one unit of strain, or to the final strain. The particle must not move.
   * Without a conformation the flow is steady at once.
   *
   * @param path of a table with a row for each step
   */
  template <int dim>
  SteadyRotation
  steady_rotation(const Scene<dim>           &scene,
                  const SimulationParameters &parameters,
                  const double                tolerance,
                  const std::string          &path,
                  const MPI_Comm              communicator);


  /**
   * The rotation of a particle at a number of shear rates.
   */
  struct RotationSweepParameters
  {
    /// Wi, or lambda_c gamma of a Carreau fluid; none: as the fluid has it
    std::vector<double> rates;
    /// steady when omega has changed by less over 1 + 2 Wi of strain [gamma]
    double tolerance = 1e-5;

    /// In a subsection `Sweep`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError
    void
    check(const SimulationParameters &simulation) const;
  };

  /**
   * Write `rotation_rate.csv` in @p directory with a row for each rate, and
   * `trajectory_RATE.csv` with the steps of its run.
   */
  template <int dim>
  void
  rotation_sweep(const Scene<dim>              &scene,
                 const SimulationParameters    &parameters,
                 const RotationSweepParameters &sweep,
                 const std::string             &directory,
                 const MPI_Comm                 communicator);
} // namespace Catena

#endif

#ifndef catena_simulation_trajectory_h
#define catena_simulation_trajectory_h

#include <catena/output/trajectory_table.h>
#include <catena/simulation/simulation.h>

#include <string>

namespace Catena
{
  /**
   * The trajectory of a simulation as a table, one row an instant. Particles
   * are numbered as in the scene. The head of each column has its unit: strain
   * and time step in 1/gamma, theta in degrees, gaps in 2a, places in a,
   * velocities in a gamma and gamma, forces in F_S = 6 pi eta0 gamma a^2, the
   * largest trace of tau in G. examples/three_particles/README.md describes
   * the columns.
   *
   * Constructors, record() and sync() are collective and throw Error if the
   * table cannot be written.
   */
  template <int dim>
  class Trajectory
  {
  public:
    Trajectory(const std::string     &path,
               const Simulation<dim> &simulation,
               const MPI_Comm         communicator);

    /// Go on after the row that ends at @p position.
    Trajectory(const std::string               &path,
               const Simulation<dim>           &simulation,
               const MPI_Comm                   communicator,
               const TrajectoryTable::Position &position);

    /// Bring all rows to the disk, and tell where the last one ends.
    TrajectoryTable::Position
    sync()
    {
      return table.sync();
    }

    /// Write the row of the present instant; @p step led to it.
    void
    record(const StepReport &step);

  private:
    const Simulation<dim> &simulation;
    TrajectoryTable        table;
    /// are there two particles, or one and its image?
    const bool has_gap;

    void
    declare_columns();

    void
    add_particles();

    void
    add_contacts();
  };
} // namespace Catena

#endif

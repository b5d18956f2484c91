#ifndef catena_simulation_run_h
#define catena_simulation_run_h

#include <catena/simulation/simulation.h>

#include <string>

namespace Catena
{
  /**
   * Run a simulation to its final strain and record it in @p directory:
   *
   * - `trajectory.csv`, a row for the start and for every step,
   * - `fields.pvd` and what it refers to, at the strains asked for,
   * - `run_report.txt`, times by part, sizes and counts,
   *
   * with a progress line on the standard output.
   *
   * @throws Error if the run cannot go on; all rows so far are in the table.
   */
  template <int dim>
  void
  run_simulation(const Scene<dim>           &scene,
                 const SimulationParameters &parameters,
                 const std::string          &directory,
                 const bool                  overwrite,
                 const MPI_Comm              communicator);
} // namespace Catena

#endif

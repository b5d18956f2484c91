#ifndef catena_simulation_run_h
#define catena_simulation_run_h

#include <catena/simulation/simulation.h>

#include <string>

namespace Catena
{
  /**
   * Where the results of a run go, and how it begins.
   */
  struct RunOptions
  {
    std::string directory;
    /// results of an earlier run may be replaced
    bool overwrite = false;
    /// go on from the last checkpoint in the directory
    bool resume = false;
  };



  /**
   * What ends a run before its final strain.
   */
  template <int dim>
  class Ending
  {
  public:
    virtual ~Ending() = default;

    /**
     * Is the present instant the end? Asked at the start and after every step,
     * also of a run that was resumed.
     *
     * @param step what led to this instant; without a length at the start
     */
    virtual bool
    reached(const Simulation<dim> &simulation, const StepReport &step) = 0;

    /// Save or load what is remembered of earlier instants.
    virtual void
    archive(Archive &archive) = 0;
  };



  /**
   * Remove what run_simulation() left in a directory, so that nothing of an
   * earlier run is taken for part of the next. Process 0 does so, the others
   * do nothing.
   */
  void
  remove_results(const std::string &directory, const MPI_Comm communicator);



  /**
   * Run a simulation to its final strain and record it in a directory:
   *
   * - `trajectory.csv`, a row for the start and for every step,
   * - `fields.pvd` and what it refers to, at the strains asked for,
   * - `run_report.txt`, times by part, sizes and counts,
   * - `checkpoint_0` and `checkpoint_1`, see Checkpoint,
   *
   * with a progress line on the standard output. A run that is resumed goes on
   * with the tables of the one before, from the row of the checkpoint.
   *
   * @param ending what may end the run earlier
   * @param prepare called with the simulation before its first step, for
   * tests
   *
   * @throws InputError if the run cannot begin like this
   * @throws CheckpointError if there is none to resume from, or it is damaged
   * @throws Interrupted after SIGTERM or SIGINT and a checkpoint
   * @throws Error if the run cannot go on; all rows so far are in the table
   */
  template <int dim>
  void
  run_simulation(const Scene<dim>                             &scene,
                 const SimulationParameters                   &parameters,
                 const RunOptions                             &options,
                 const MPI_Comm                                communicator,
                 Ending<dim>                                  *ending = nullptr,
                 const std::function<void(Simulation<dim> &)> &prepare = {});
} // namespace Catena

#endif

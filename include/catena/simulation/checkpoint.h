#ifndef catena_simulation_checkpoint_h
#define catena_simulation_checkpoint_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace Catena
{
  /**
   * When checkpoints are written, besides at the start, at the end and at a
   * signal.
   */
  struct CheckpointParameters
  {
    bool enabled = true;
    /// strain between two checkpoints, 0: by wall time alone
    double strain_interval = 0.;
    /// wall time between two checkpoints [min]
    double wall_time_interval = 10.;

    /// Declare the entries in the current subsection.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * The last two checkpoints of a run, in the files `checkpoint_0` and
   * `checkpoint_1` of its folder. They are written in turn, each as a
   * CheckedFile: whenever the program or the computer stops, the last complete
   * one can be used, and if it is damaged later on, the one before.
   *
   * The content of the file is an Archive:
   *
   * - the number of the checkpoint, 64 bits, and its strain;
   * - dimension, and names and values of all parameters and of the scene;
   * - the simulation, see Simulation::archive(): step control, contacts, mesh,
   *   fields of two levels, what the solvers start from;
   * - how much of `trajectory.csv` there was in bytes and rows, the files of
   *   `fields.pvd`, the counters of the report.
   *
   * Nodes are numbered as the cells meet them, which is the same on any number
   * of processes. Fields are gathered on process 0, which writes the file;
   * it needs room for all of it in its memory.
   */
  class Checkpoint
  {
  public:
    /// Increased whenever what is archived changes.
    static constexpr unsigned int version = 7;

    Checkpoint(const std::string &directory, const MPI_Comm communicator);

    /// Is there one, good or damaged? Collective.
    bool
    exists() const;

    /// Remove what is left of an earlier run. Collective.
    void
    clear();

    /**
     * Write what process 0 has in @p pieces as the state at @p strain.
     * Collective.
     * @throws CheckpointError if that fails; the one before is still there
     */
    void
    write(std::vector<std::string> pieces, const double strain);

    /**
     * The last usable content, the same on all processes. Collective.
     * @throws CheckpointError if there is none
     */
    std::string
    read();

    /// Strain of the last one that was written or read.
    const std::optional<double> &
    strain() const
    {
      return last_strain;
    }

  private:
    const std::string     directory;
    const MPI_Comm        communicator;
    std::uint64_t         number = 0; ///< of the last one
    std::optional<double> last_strain;

    std::string
    slot(const std::uint64_t number) const;

    std::string
    newest();
  };
} // namespace Catena

#endif

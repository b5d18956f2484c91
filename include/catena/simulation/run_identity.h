#ifndef catena_simulation_run_identity_h
#define catena_simulation_run_identity_h

#include <catena/base/archive.h>
#include <catena/scene/scene.h>
#include <catena/simulation/parameters.h>

#include <string>
#include <vector>

namespace Catena
{
  /**
   * Which run it is: the names and values of all parameters of a simulation
   * and of its scene. A run that goes on from a checkpoint has to be the same,
   * but for what has no influence on the past: the final strain, tolerances,
   * limits of solvers and of the time for a mesh, the output and the
   * checkpoints.
   */
  class RunIdentity
  {
  public:
    /// An empty one to load.
    RunIdentity() = default;

    template <int dim>
    RunIdentity(const Scene<dim> &scene, SimulationParameters parameters);

    /**
     * @throws InputError that names the first parameter in which this run is
     * not the one of @p checkpoint
     */
    void
    check_continues(const RunIdentity &checkpoint) const;

    /// Save or load it.
    void
    archive(Archive &archive)
    {
      archive(names, values);
    }

  private:
    std::vector<std::string> names, values;

    template <typename T>
    void
    add(const std::string &name, const T &value);
  };
} // namespace Catena

#endif

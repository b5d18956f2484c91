#ifndef catena_simulation_extrapolation_h
#define catena_simulation_extrapolation_h

#include <catena/base/time_history.h>
#include <catena/simulation/state.h>

#include <vector>

namespace Catena
{
  /**
   * The velocity of the nodes at the end of the step from @p state to @p next,
   * by the differences of the step in time.
   */
  template <int dim>
  VectorType
  mesh_velocity(const State<dim> &state,
                const Level<dim> &next,
                const TimeStep   &step);

  /// Velocity, pressure and motions at the end of a step from the last two.
  template <int dim>
  FlowFields<dim>
  extrapolated_flow(const State<dim> &state, const TimeStep &step);

  /// The log-conformation at the end of a step from the last two.
  template <int dim>
  std::vector<VectorType>
  extrapolated_log_conformation(const State<dim> &state, const TimeStep &step);
} // namespace Catena

#endif

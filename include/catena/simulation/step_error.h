#ifndef catena_simulation_step_error_h
#define catena_simulation_step_error_h

#include <catena/base/time_history.h>
#include <catena/simulation/state.h>
#include <catena/simulation/step_control.h>

#include <vector>

namespace Catena
{
  /**
   * The errors of the step from @p state to @p next. The local one is the
   * larger one of two: that of the positions of the particles' surfaces, which
   * turn, too, by the difference of Adams-Bashforth and trapezoidal rule, and
   * what the extrapolation of the log-conformation misses, times the step. The
   * velocities jump where a contact opens or closes; there the gap is exact.
   *
   * @param predicted the extrapolated log-conformation
   * @param held the particles are held in place
   * @param on_a_new_mesh the mesh is not that of the step before
   *
   * @throws SolverError if the conformation changes too fast to be followed, or
   * a value is not finite
   */
  template <int dim>
  StepError
  step_error(const State<dim>              &state,
             const Level<dim>              &next,
             const std::vector<VectorType> &predicted,
             const TimeStep                &step,
             const bool                     held,
             const bool                     on_a_new_mesh);
} // namespace Catena

#endif

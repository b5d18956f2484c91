#ifndef catena_simulation_step_control_h
#define catena_simulation_step_control_h

#include <catena/base/archive.h>

#include <deal.II/base/parameter_handler.h>

namespace Catena
{
  /**
   * How long the time steps are, in 1/gamma.
   */
  struct StepControlParameters
  {
    /// of all steps, or the first one where they are controlled
    double time_step = 0.08;
    /// local error to which the steps are controlled, 0: not at all
    double tolerance = 0.;
    /// of controlled steps
    double largest_step = 0.32;

    void
    declare(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * Chooses the time steps. The scheme is of second order, so the local error,
   * that of one step, goes with dt^3. With a tolerance, the next step is the
   * one whose error would be a little smaller,
   *
   *   dt_next = 0.9 dt (tolerance / error)^(1/3),
   *
   * and a step with twice the tolerance is rejected. Without one, the steps
   * have the length of the parameters. A step that fails is repeated with half
   * its length in both cases, and the length recovers afterwards.
   */
  class StepControl
  {
  public:
    explicit StepControl(const StepControlParameters &parameters);

    /// The wanted length of the next step.
    double
    next_step() const
    {
      return wanted;
    }

    /**
     * A step of length @p dt, at most the wanted one, has this local error.
     * @return whether it is accepted; if not, it is to be repeated
     */
    bool
    accept(const double dt, const double error);

    /**
     * A step of length @p dt has failed.
     * @return whether to try a shorter one
     */
    bool
    shorten(const double dt);

    /// Start afresh with the first step, where the flow changes abruptly.
    void
    restart();

    /// Save or load what the next step depends on.
    void
    archive(Archive &archive)
    {
      archive(wanted, may_grow);
    }

  private:
    const StepControlParameters parameters;
    double                      wanted;
    bool may_grow = true; ///< not in the step after a bad one

    double
    smallest_step() const;
  };
} // namespace Catena

#endif

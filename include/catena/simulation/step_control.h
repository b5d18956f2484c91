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
    double largest_step = 0.64;

    /// Declare the entries in the current subsection.
    void
    declare(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * The errors of one time step.
   */
  struct StepError
  {
    /// A log-conformation off its extrapolation by more is not followed: the
    /// stress is predicted with that extrapolation, and the step fails.
    static constexpr double failing_change = 1.;

    /// The same at single vertices in the step onto a new mesh, where the former
    /// limit is that of the mean. Steep stresses that elements do not resolve
    /// are not in balance on another mesh: they jump, however short the step.
    static constexpr double failing_change_on_a_new_mesh = 5.;

    /// of the positions of surfaces [a] and of the log-conformation in the mean
    double local = 0.;
    /// by how much the log-conformation is off its extrapolation where it is
    /// most
    double largest_change = 0.;
  };



  /**
   * Chooses the time steps. The scheme is of second order: the local error,
   * that of one step, goes with dt^3, and the log-conformation is off its
   * extrapolation by dt^2. With a tolerance, the next step is the one whose
   * error would be a little smaller and at most half of the change with which
   * a step fails,
   *
   *   dt_next = dt min(0.9 (tolerance / local)^(1/3),
   *                    (0.5 / largest_change)^(1/2)),
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
     * A step of length @p dt, at most the wanted one, has these errors.
     * @return whether it is accepted; if not, it is to be repeated
     */
    bool
    accept(const double dt, const StepError &error);

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

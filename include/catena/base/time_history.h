#ifndef catena_base_time_history_h
#define catena_base_time_history_h

namespace Catena
{
  /**
   * Weights of the second-order backward difference with a variable step,
   *
   * @f[ \dot y(t^{n+1}) \approx
   *     \frac{a_0 y^{n+1} + a_1 y^n + a_2 y^{n-1}}{\Delta t}, \qquad
   *     a_0 = \frac{1 + 2w}{1 + w},\; a_1 = -(1 + w),\;
   *     a_2 = \frac{w^2}{1 + w}, @f]
   *
   * with @f$\Delta t = t^{n+1} - t^n@f$ and
   * @f$w = \Delta t / (t^n - t^{n-1})@f$. In the first step after a start the
   * weights are those of the implicit Euler formula, (1, -1, 0).
   */
  struct BdfCoefficients
  {
    double a0 = 1.;
    double a1 = -1.;
    double a2 = 0.;
  };

  /**
   * Weights of the present and of the previous level in a formula that looks
   * ahead: @f$b_0 (\cdot)^n + b_1 (\cdot)^{n-1}@f$.
   */
  struct TwoLevelWeights
  {
    double b0 = 1.;
    double b1 = 0.;
  };

  /**
   * A time step together with the one before it, both in units 1/gamma, and
   * the formulas of second order that follow from the two. Without a previous
   * step they fall back to their first-order relatives.
   */
  struct TimeStep
  {
    /**
     * Length of the step from @f$t^n@f$ to @f$t^{n+1}@f$.
     */
    double dt = 0.;

    /**
     * Length of the step from @f$t^{n-1}@f$ to @f$t^n@f$; zero if there is
     * none.
     */
    double previous_dt = 0.;

    /**
     * Is there a previous step, so that formulas of second order can be used?
     */
    bool
    has_previous() const;

    /**
     * The ratio @f$w@f$ of this step to the previous one; zero if there is
     * none.
     */
    double
    ratio() const;

    /**
     * Weights of the time derivative at @f$t^{n+1}@f$, see BdfCoefficients.
     */
    BdfCoefficients
    bdf() const;

    /**
     * Weights of the extrapolation to @f$t^{n+1}@f$,
     * @f$\hat y = (1 + w) y^n - w y^{n-1}@f$; first order:
     * @f$\hat y = y^n@f$.
     */
    TwoLevelWeights
    extrapolation() const;

    /**
     * Weights of the Adams-Bashforth formula
     * @f$y^{n+1} = y^n + \Delta t (b_0 f^n + b_1 f^{n-1})@f$,
     * @f$b_0 = 1 + w/2@f$, @f$b_1 = -w/2@f$; first order: forward Euler.
     */
    TwoLevelWeights
    adams_bashforth() const;

    /**
     * The step that follows this one, of length @p next_dt.
     */
    TimeStep
    next(const double next_dt) const;
  };
} // namespace Catena

#endif

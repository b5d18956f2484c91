// The backward difference, the extrapolation and the Adams-Bashforth formula
// are exact for the polynomials they should be exact for, and of second order
// for y' = -y with steps that change by a factor of three.

#include <catena/base/time_history.h>

#include <cmath>

#include "../tests.h"

using namespace Catena;

namespace
{
  /**
   * The i-th of a sequence of uneven steps with mean @p mean.
   */
  double
  uneven(const unsigned int i, const double mean)
  {
    return mean * (i % 2 == 0 ? 0.5 : 1.5);
  }



  /**
   * Error at t = 1 of y' = -y, y(0) = 1, from two exact values on.
   */
  double
  error_of_decay(const unsigned int n_steps, const bool implicit)
  {
    const double h = 1. / n_steps;

    TimeStep step{uneven(0, h)};
    double   t   = step.dt;
    double   old = 1.;
    double   y   = std::exp(-t);
    for (unsigned int i = 1; i < n_steps; ++i)
      {
        step = step.next(uneven(i, h));
        t += step.dt;

        double next;
        if (implicit)
          {
            const BdfCoefficients bdf = step.bdf();
            next = -(bdf.a1 * y + bdf.a2 * old) / (bdf.a0 + step.dt);
          }
        else
          {
            const TwoLevelWeights ab = step.adams_bashforth();
            next                     = y - step.dt * (ab.b0 * y + ab.b1 * old);
          }
        old = y;
        y   = next;
      }
    return std::abs(y - std::exp(-t));
  }



  double
  order(const bool implicit)
  {
    return std::log2(error_of_decay(200, implicit) /
                     error_of_decay(400, implicit));
  }



  void
  test(Tests::Claims &claims)
  {
    const TimeStep        step{0.3, 0.2};
    const BdfCoefficients bdf = step.bdf();
    const auto   y   = [](const double t) { return 2. - t + 3. * t * t; };
    const auto   f   = [](const double t) { return -1. + 6. * t; };
    const double now = 0.7, next = now + step.dt, old = now - step.previous_dt;

    claims.near("derivative of a parabola",
                (bdf.a0 * y(next) + bdf.a1 * y(now) + bdf.a2 * y(old)) /
                  step.dt,
                f(next),
                1e-13);
    claims.near("extrapolation of a straight line",
                step.extrapolation().b0 * f(now) +
                  step.extrapolation().b1 * f(old),
                f(next),
                1e-13);
    claims.near("Adams-Bashforth step along a parabola",
                y(now) + step.dt * (step.adams_bashforth().b0 * f(now) +
                                    step.adams_bashforth().b1 * f(old)),
                y(next),
                1e-13);

    const TimeStep first{0.3};
    claims.near("implicit Euler first, a0", first.bdf().a0, 1., 0.);
    claims.near("implicit Euler first, a1", first.bdf().a1, -1., 0.);
    claims.near("implicit Euler first, a2", first.bdf().a2, 0., 0.);
    claims.near("no extrapolation first", first.extrapolation().b0, 1., 0.);
    claims.near("forward Euler first", first.adams_bashforth().b0, 1., 0.);

    claims.near("order of the backward difference", order(true), 2., 0.05);
    claims.near("order of Adams-Bashforth", order(false), 2., 0.05);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

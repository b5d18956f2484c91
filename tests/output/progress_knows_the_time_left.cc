// In a log, progress takes a line for each 5 % of the run or 30 seconds; on a
// terminal one line is rewritten. The time left is that of the recent steps.

#include <catena/output/progress.h>

#include <algorithm>
#include <sstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  /**
   * A run of 1000 steps from strain 0 to 10, each @p seconds long.
   */
  std::string
  log_of(const double seconds, const bool terminal)
  {
    std::ostringstream out;
    double             now = 0.;
    Progress progress(0., 10., MPI_COMM_WORLD, out, terminal, [&now]() {
      return now;
    });
    for (unsigned int i = 1; i <= 1000; ++i)
      {
        now += seconds;
        progress.update({0.01 * i, 45., 0.01, 7});
        if (i == 500)
          progress.message("remeshed");
      }
    progress.finish();
    return out.str();
  }



  unsigned int
  lines(const std::string &text)
  {
    return std::count(text.begin(), text.end(), '\n');
  }



  void
  test(Tests::Claims &claims)
  {
    claims.near("lines of a fast run: each 5 %, message",
                lines(log_of(1e-3, false)),
                21.,
                1.);
    claims.near("lines of a slow run: each 30 s, message",
                lines(log_of(2., false)),
                2000. / 30. + 1.,
                3.);
    claims.near("lines on a terminal: message, last one",
                lines(log_of(2., true)),
                2.,
                0.);

    double             now = 0.;
    std::ostringstream out;
    Progress           progress(0., 10., MPI_COMM_WORLD, out, false, [&now]() {
      return now;
    });
    for (unsigned int i = 1; i <= 50; ++i)
      {
        now += i < 25 ? 100. : 2.;
        progress.update({0.1 * i, 45., 0.1, 7});
      }
    claims.near("seconds left", progress.seconds_left(), 100., 1e-6);
    progress.finish();
    claims.holds("line",
                 out.str().find("strain 5.00 of 10, theta 45.0 deg, "
                                "dt 0.1, 7 its, 2 s/step, 1 min 40 s "
                                "left") != std::string::npos);

    claims.holds("4.2 s", duration_in_words(4.2) == "4.2 s");
    claims.holds("1 min 00 s", duration_in_words(59.6) == "1 min 00 s");
    claims.holds("2 h 05 min", duration_in_words(7500.) == "2 h 05 min");
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

#ifndef catena_simulation_health_watch_h
#define catena_simulation_health_watch_h

#include <catena/base/archive.h>
#include <catena/conformation/conformation_solver.h>
#include <catena/output/progress.h>
#include <catena/output/run_report.h>

namespace Catena
{
  /**
   * Says once when the conformation is stretched so far that no mesh of this
   * kind resolves its layers, as in a fluid whose stress has no bound in a
   * steady extension (alpha = 0): such a run may have no steady state.
   */
  class HealthWatch
  {
  public:
    /**
     * Note the largest |log c| so far in @p report, and warn by @p progress
     * at the first that is suspicious.
     */
    void
    look_at(const ConformationExtremes &extremes,
            const double                strain,
            Progress                   &progress,
            RunReport                  &report);

    void
    archive(Archive &archive);

  private:
    /// a stretch of e^8 = 3000 in c
    static constexpr double suspicious_log = 8.;

    double largest = 0.;
    bool   warned  = false;
  };
} // namespace Catena

#endif

#include <catena/simulation/health_watch.h>

#include <algorithm>
#include <sstream>

namespace Catena
{
  void
  HealthWatch::look_at(const ConformationExtremes &extremes,
                       const double                strain,
                       Progress                   &progress,
                       RunReport                  &report)
  {
    largest = std::max(largest, extremes.largest_log);
    report.note("largest |log c|", largest);
    if (warned || largest < suspicious_log)
      return;
    warned = true;
    report.note("health warning from strain", strain);
    std::ostringstream text;
    text << "Warning: at strain " << strain
         << " the log-conformation has reached " << largest
         << ". The stress beside the particles is not resolved, and it may "
            "have no steady state.";
    progress.message(text.str());
  }



  void
  HealthWatch::archive(Archive &archive)
  {
    archive(largest, warned);
  }
} // namespace Catena

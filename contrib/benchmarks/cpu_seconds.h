#ifndef catena_contrib_cpu_seconds_h
#define catena_contrib_cpu_seconds_h

#include <deal.II/base/timer.h>

/// CPU seconds that @p part takes.
template <typename Part>
double
cpu_seconds(const Part &part)
{
  dealii::Timer timer;
  part();
  return timer.cpu_time();
}

#endif

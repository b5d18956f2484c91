#ifndef catena_base_wall_clock_h
#define catena_base_wall_clock_h

namespace Catena
{
  /**
   * Seconds since some fixed time.
   */
  double
  wall_clock();
} // namespace Catena

#endif

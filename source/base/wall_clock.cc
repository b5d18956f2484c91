#include <catena/base/wall_clock.h>

#include <chrono>

namespace Catena
{
  double
  wall_clock()
  {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  }
} // namespace Catena

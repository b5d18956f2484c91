#ifndef catena_base_replicated_h
#define catena_base_replicated_h

#include <catena/base/types.h>

#include <vector>

namespace Catena
{
  /// The values of a block that rank 0 owns, on every rank.
  template <typename Vector>
  std::vector<double>
  replicate(const Vector &block);

  /// Set a block that rank 0 owns.
  template <typename Vector>
  void
  set_replicated(Vector &block, const std::vector<double> &values);
} // namespace Catena

#endif

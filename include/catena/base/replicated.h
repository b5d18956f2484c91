#ifndef catena_base_replicated_h
#define catena_base_replicated_h

#include <catena/base/types.h>

#include <vector>

namespace Catena
{
  /// The values of a block that rank 0 owns, on every rank.
  std::vector<double>
  replicate(const VectorType &block);

  /// Set a block that rank 0 owns.
  void
  set_replicated(VectorType &block, const std::vector<double> &values);
} // namespace Catena

#endif

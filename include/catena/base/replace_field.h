#ifndef catena_base_replace_field_h
#define catena_base_replace_field_h

#include <catena/base/types.h>

namespace Catena
{
  /**
   * Put a field of another mesh in place of @p field and import its ghost
   * values, whether or not @p other has them.
   *
   * Assigned to, a vector keeps the ghost indices it has if both own the same
   * range on each rank, as fields of different meshes may.
   */
  inline void
  replace_field(VectorType &field, const VectorType &other)
  {
    field.reinit(0);
    field = other;
    field.update_ghost_values();
  }
} // namespace Catena

#endif

#ifndef catena_base_release_memory_h
#define catena_base_release_memory_h

#include <cstdlib>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace Catena
{
  /**
   * Give memory that was freed back to the operating system. SuperLU_DIST, with
   * which deal.II can be linked, tells malloc never to do so by itself. It is
   * slow where the memory is soon needed again.
   */
  inline void
  release_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Catena

#endif

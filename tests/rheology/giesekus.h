#ifndef catena_tests_rheology_giesekus_h
#define catena_tests_rheology_giesekus_h

#include <catena/rheology/giesekus.h>

namespace Catena
{
  namespace Tests
  {
    inline GiesekusParameters
    giesekus(const double Wi, const double alpha, const double beta)
    {
      GiesekusParameters parameters;
      parameters.weissenberg_number      = Wi;
      parameters.mobility_parameter      = alpha;
      parameters.solvent_viscosity_ratio = beta;
      return parameters;
    }
  } // namespace Tests
} // namespace Catena

#endif

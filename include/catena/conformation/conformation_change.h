#ifndef catena_conformation_conformation_change_h
#define catena_conformation_conformation_change_h

#include <catena/base/types.h>
#include <catena/mesh/moving_mesh.h>

#include <vector>

namespace Catena
{
  /**
   * How far two log-conformations differ: at most at a vertex, and in the mean
   * over the elastic energy,
   *
   * @f[ \left( \int |s - \hat s|^2 \, \mathrm{tr}(c - I) \Big/
   *     \int \mathrm{tr}(c - I) \right)^{1/2}, \qquad c = \exp(s) , @f]
   *
   * with the integrals by the vertices of the cells; 0 at rest.
   */
  struct ConformationChange
  {
    double largest = 0.;
    double mean    = 0.;
  };

  template <int dim>
  ConformationChange
  conformation_change(const MovingMesh<dim>         &mesh,
                      const std::vector<VectorType> &s,
                      const std::vector<VectorType> &s_hat);
} // namespace Catena

#endif

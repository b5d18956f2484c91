#ifndef catena_flow_gap_pressures_h
#define catena_flow_gap_pressures_h

#include <catena/base/types.h>
#include <catena/flow/block_matrix.h>
#include <catena/flow/sparse_vectors.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/scene/configuration.h>

#include <vector>

namespace Catena
{
  /**
   * Pressures of the films between particles that are close to each other, for
   * which a pressure mass matrix M is no good Schur complement: that of a film
   * of width w is -div(w^3/12 grad p).
   *
   * They are functions of the share q = w_min/w of the smallest width and of
   * the place x on the tangential plane, those of which lubrication theory has
   * its pressures: q^2 and q^4, from squeezing, and x_t q^3 in each tangential
   * direction, from shearing; in a very narrow film, whose pressures have more
   * forms, also q and x_t q^2. They have the symmetries of the scene, and are
   * made orthonormal in M; forms that do not have those symmetries, or that the
   * mesh does not tell apart, are left out, and where there are many films the
   * wider ones. Particles that are both fixed have no film, nor have walls.
   *
   * The constructor, products() and remove() are collective.
   */
  template <int dim>
  class GapPressures
  {
  public:
    GapPressures() = default;

    /// @param mass M, which is not kept
    GapPressures(const MovingMesh<dim>    &mesh,
                 const Configuration<dim> &configuration,
                 const BlockMatrix<1>     &mass);

    unsigned int
    size() const
    {
      return pressures.size();
    }

    /// dst += factor p_k
    void
    add_to(FastVectorType &dst, const unsigned int k, const double factor) const
    {
      pressures.add_to(dst, k, factor);
    }

    /// Products of @p src, a functional of pressures, with each p_k.
    std::vector<double>
    products(const FastVectorType &src) const
    {
      return pressures.products(src);
    }

    /// Take M p_k times its product away from @p src: the products are zero
    /// then.
    void
    remove(FastVectorType &src, const std::vector<double> &products) const;

  private:
    /// p_k and M p_k
    SparseVectors pressures, mass_products;
  };
} // namespace Catena

#endif

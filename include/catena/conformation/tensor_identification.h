#ifndef catena_conformation_tensor_identification_h
#define catena_conformation_tensor_identification_h

#include <catena/base/types.h>
#include <catena/mesh/moving_mesh.h>

#include <array>
#include <vector>

namespace Catena
{
  /**
   * Which values of a symmetric P1 tensor field are free: at a vertex,
   *
   *   component k = factor(k) * component k at the master of the vertex,
   *
   * with the factor -1 of a component that is odd under the rotation about z
   * at a turned vertex, and 0 of one that vanishes on an axis or on a mirror
   * plane.
   */
  template <int dim>
  class TensorIdentification
  {
  public:
    TensorIdentification() = default;

    explicit TensorIdentification(const MovingMesh<dim> &mesh);

    unsigned int
    master(const unsigned int vertex) const
    {
      return masters[vertex];
    }

    signed char
    factor(const unsigned int component, const unsigned int vertex) const
    {
      return component_factors[component][vertex];
    }

    const std::vector<signed char> &
    factors(const unsigned int component) const
    {
      return component_factors[component];
    }

    bool
    is_free(const unsigned int component, const unsigned int vertex) const
    {
      return masters[vertex] == vertex && factor(component, vertex) != 0;
    }

    /**
     * The field whose values at the masters are @p values, which need no
     * ghost values.
     */
    VectorType
    field(const unsigned int     component,
          const MovingMesh<dim> &mesh,
          const VectorType      &values) const;

    /// The same for all components, a block of @p values for each.
    std::vector<VectorType>
    fields(const MovingMesh<dim> &mesh, const BlockVectorType &values) const;

    /// Values at the masters, all zero: a block for each component.
    static BlockVectorType
    zero(const MovingMesh<dim> &mesh);

  private:
    std::vector<unsigned int> masters;
    std::array<std::vector<signed char>, n_symmetric_components(dim)>
      component_factors;
  };
} // namespace Catena

#endif

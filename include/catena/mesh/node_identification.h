#ifndef catena_mesh_node_identification_h
#define catena_mesh_node_identification_h

#include <catena/scene/scene.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cstdint>
#include <vector>

namespace Catena
{
  /// Does component @p k of a symmetric tensor (deal.II's order) change its
  /// sign when the tensor is turned by 180 degrees about z?
  template <int dim>
  bool
  changes_sign_about_z(const unsigned int k)
  {
    const auto ij =
      dealii::SymmetricTensor<2, dim>::unrolled_to_component_indices(k);
    return (ij[0] < 2) != (ij[1] < 2);
  }



  /**
   * Which nodes of a mesh are images of each other under the rotation and the
   * period of a scene.
   *
   * Every node has a master; the field at the node is the field at the master,
   * rotated by 180 degrees about z if the node is `turned` against it:
   * x and y components of a vector and the xz and yz components of a tensor
   * change sign. A node that is its own rotated image lies on an axis, where
   * those components vanish.
   */
  class NodeIdentification
  {
  public:
    /**
     * Match the @p points whose bit b of @p boundaries tells that they lie on
     * the boundary with id b (< 6).
     *
     * @throws MeshError if a node has no counterpart within 1e-6 a.
     */
    template <int dim>
    NodeIdentification(const Scene<dim>                      &scene,
                       const std::vector<dealii::Point<dim>> &points,
                       const std::vector<std::uint32_t>      &boundaries);

    unsigned int
    master(const unsigned int node) const
    {
      return masters[node];
    }

    bool
    turned(const unsigned int node) const
    {
      return turns[node] != 0;
    }

    bool
    on_axis(const unsigned int node) const
    {
      return axis[masters[node]] != 0;
    }

    /// Factor of vector component @p d at @p node against its master.
    double
    vector_factor(const unsigned int node, const unsigned int d) const
    {
      if (d >= 2)
        return 1.;
      return on_axis(node) ? 0. : (turned(node) ? -1. : 1.);
    }

    /**
     * Factor of component @p k (deal.II's order) of a symmetric tensor at
     * @p node against its master.
     */
    template <int dim>
    double
    tensor_factor(const unsigned int node, const unsigned int k) const
    {
      return changes_sign_about_z<dim>(k) ? vector_factor(node, 0) : 1.;
    }

  private:
    std::vector<unsigned int> masters;
    std::vector<char>         turns;
    std::vector<char>         axis;

    unsigned int
    root(unsigned int node, char &turn) const;

    void
    unite(const unsigned int a, const unsigned int b, const bool rotation);
  };
} // namespace Catena

#endif

#ifndef catena_flow_node_couplings_h
#define catena_flow_node_couplings_h

#include <catena/mesh/moving_mesh.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <vector>

namespace Catena
{
  /// Share of a rigid-body unknown in a component of the velocity of a node.
  struct NodeMotion
  {
    unsigned int component, unknown;
    double       factor;
  };



  /**
   * The constraints of the velocity read node by node: a node stands for itself
   * or its master, each component with a factor (0: no unknown), or it belongs
   * to a particle.
   */
  template <int dim>
  struct NodeCoupling
  {
    unsigned int            master;
    std::array<double, dim> factors;

    /// known part of the velocity
    std::array<double, dim> known;

    /// of a node on a particle, component by component
    std::vector<NodeMotion> motions;

    bool
    has_unknown() const
    {
      for (const double f : factors)
        if (f != 0.)
          return true;
      return false;
    }

    /// Whether component @p d is an unknown itself.
    /// @param node the node this is the coupling of
    bool
    is_unknown(const unsigned int node, const unsigned int d) const
    {
      return master == node && factors[d] != 0.;
    }

    /// The factor that @p components share where they have an unknown, 0 if
    /// none of them has one.
    double
    shared_factor(const std::vector<unsigned int> &components) const
    {
      for (const unsigned int d : components)
        if (factors[d] != 0.)
          return factors[d];
      return 0.;
    }
  };

  /**
   * The coupling of every relevant node, indexed by node.
   */
  template <int dim>
  std::vector<NodeCoupling<dim>>
  node_couplings(const MovingMesh<dim>                   &mesh,
                 const dealii::AffineConstraints<double> &constraints);
} // namespace Catena

#endif

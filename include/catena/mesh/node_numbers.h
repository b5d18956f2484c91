#ifndef catena_mesh_node_numbers_h
#define catena_mesh_node_numbers_h

#include <catena/base/pack.h>
#include <catena/base/types.h>

#include <array>

namespace Catena
{
  /**
   * A number for each P2 node of a cell, some at once; those beyond the nodes
   * are zero.
   */
  template <int dim>
  struct NodeNumbers
  {
    static constexpr unsigned int n_nodes = n_quadratic_nodes(dim);
    static constexpr unsigned int n_packs =
      (n_nodes + pack_size - 1) / pack_size;

    std::array<Pack, n_packs> packs = {};

    double
    operator[](const unsigned int a) const
    {
      return packs[a / pack_size][a % pack_size];
    }

    void
    set(const unsigned int a, const double value)
    {
      packs[a / pack_size][a % pack_size] = value;
    }

    /// this += factor x
    void
    add(const double factor, const NodeNumbers &x)
    {
      for (unsigned int k = 0; k < n_packs; ++k)
        packs[k] += factor * x.packs[k];
    }

    /// The sum of the products over the nodes.
    double
    operator*(const NodeNumbers &x) const
    {
      Pack sum = packs[0] * x.packs[0];
      for (unsigned int k = 1; k < n_packs; ++k)
        sum += packs[k] * x.packs[k];
      return reduce(sum);
    }
  };



  /**
   * A vector for each P2 node of a cell, component by component.
   */
  template <int dim>
  struct NodeVectors
  {
    std::array<NodeNumbers<dim>, dim> components = {};

    dealii::Tensor<1, dim>
    operator[](const unsigned int a) const
    {
      dealii::Tensor<1, dim> vector;
      for (unsigned int d = 0; d < dim; ++d)
        vector[d] = components[d][a];
      return vector;
    }

    void
    set(const unsigned int a, const dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        components[d].set(a, vector[d]);
    }

    /// this += factor x
    void
    add(const double factor, const NodeVectors &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        components[d].add(factor, x.components[d]);
    }

    /// this += M x
    template <typename Matrix>
    void
    add_product(const Matrix &M, const NodeVectors &x)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          components[i].add(M[i][j], x.components[j]);
    }
  };
} // namespace Catena

#endif

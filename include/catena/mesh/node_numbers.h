#ifndef catena_mesh_node_numbers_h
#define catena_mesh_node_numbers_h

#include <catena/base/types.h>

#include <deal.II/base/tensor.h>

#include <array>

#include <experimental/simd>

namespace Catena
{
  /**
   * A number for each P2 node of a cell, in whole registers of the processor;
   * those beyond the nodes are zero.
   */
  template <int dim>
  struct NodeNumbers
  {
    using Register = std::experimental::native_simd<double>;

    static constexpr unsigned int n_nodes     = n_quadratic_nodes(dim);
    static constexpr unsigned int width       = Register::size();
    static constexpr unsigned int n_registers = (n_nodes + width - 1) / width;

    std::array<Register, n_registers> registers = {};

    double
    operator[](const unsigned int a) const
    {
      return registers[a / width][a % width];
    }

    void
    set(const unsigned int a, const double value)
    {
      registers[a / width][a % width] = value;
    }

    /// this += factor x
    void
    add(const double factor, const NodeNumbers &x)
    {
      for (unsigned int r = 0; r < n_registers; ++r)
        registers[r] += factor * x.registers[r];
    }

    /// The sum of the products over the nodes.
    double
    operator*(const NodeNumbers &x) const
    {
      Register sum = registers[0] * x.registers[0];
      for (unsigned int r = 1; r < n_registers; ++r)
        sum += registers[r] * x.registers[r];
      return std::experimental::reduce(sum);
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

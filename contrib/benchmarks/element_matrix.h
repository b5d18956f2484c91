#ifndef catena_benchmarks_element_matrix_h
#define catena_benchmarks_element_matrix_h

#include <catena/flow/stress_model.h>
#include <catena/mesh/cell_values.h>

#include <array>
#include <vector>

/**
 * The matrix of momentum and mass of one cell: its velocities node by node,
 * then its pressures.
 */
struct ElementMatrix
{
  static constexpr unsigned int n_nodes = 10, n_vertices = 4,
                                n = 3 * n_nodes + n_vertices;

  std::array<std::array<double, n>, n> entries;

  void
  integrate(const std::vector<Catena::CellValues<3>::PointValues> &points,
            const std::vector<Catena::StressCoefficients<3>>      &coefficients)
  {
    using Catena::NodeNumbers;
    using Catena::NodeVectors;

    // by point, H grad of the shape functions times the weight
    std::vector<NodeVectors<3>> fluxes(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      fluxes[q].add_product(points[q].JxW * coefficients[q].viscosity,
                            points[q].quadratic_gradient);

    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        NodeNumbers<3> trace;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              NodeNumbers<3> sums;
              for (unsigned int q = 0; q < points.size(); ++q)
                sums.add(points[q].quadratic_gradient.components[j][a],
                         fluxes[q].components[i]);
              for (unsigned int b = 0; b < n_nodes; ++b)
                entries[3 * a + i][3 * b + j] = sums[b];
              if (i == j)
                trace.add(1., sums);
            }
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int b = 0; b < n_nodes; ++b)
            entries[3 * a + i][3 * b + i] += trace[b];
      }

    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        const unsigned int row = 3 * n_nodes + v;
        NodeVectors<3>     divergence;
        for (const auto &point : points)
          divergence.add(-point.JxW * point.linear[v],
                         point.quadratic_gradient);
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int j = 0; j < 3; ++j)
            entries[row][3 * b + j] = entries[3 * b + j][row] =
              divergence.components[j][b];
        for (unsigned int w = 0; w < n_vertices; ++w)
          entries[row][3 * n_nodes + w] = 0.;
      }
  }
};

#endif

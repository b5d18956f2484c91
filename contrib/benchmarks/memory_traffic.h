#ifndef catena_contrib_benchmarks_memory_traffic_h
#define catena_contrib_benchmarks_memory_traffic_h

#include <catena/flow/flow_system.h>
#include <catena/flow/preconditioner_matrices.h>
#include <catena/flow/refined_gmres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cpu_seconds.h"

namespace Catena
{
  /**
   * Bytes that a processor moves in a second of a = b + s c on vectors that no
   * cache holds (McCalpin's triad), the best of some times.
   */
  inline double
  memory_bandwidth()
  {
    constexpr std::size_t n = 16'000'000;
    std::vector<double>   a(n, 1.), b(n, 2.), c(n, 3.);
    double                seconds = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < 5; ++k)
      {
        const double s = k;
        seconds        = std::min(seconds, cpu_seconds([&] {
                             for (std::size_t i = 0; i < n; ++i)
                               a[i] = b[i] + s * c[i];
                           }));
      }
    return 3. * n * sizeof(double) / seconds;
  }



  /**
   * Bytes that FlowSolver has to move for a solution: what it knows of the
   * cells and the vector of the nodes for each product, every entry and every
   * index of the matrices of the preconditioner once for each product and each
   * sweep over them (those below the diagonal of the velocity's operator), with
   * the vectors of the sweep, and the basis of GMRES twice for each of its
   * vectors. At the end of a basis the preconditioner is applied once more.
   * What the coarser levels of the multigrid and the other vectors take is left
   * out.
   */
  inline double
  bytes_of_a_solution(const FlowSystem<3>             &system,
                      const PreconditionerMatrices<3> &matrices,
                      const double                     iterations)
  {
    constexpr double index = 4., single = 4., whole = 8.;
    constexpr double sweeps = 2., mass_products = 2., earlier_solutions = 4.,
                     residuals  = 2.;
    constexpr double basis_size = RefinedGmres<3>::basis_size;
    // the right-hand side is read or written, residual and solution are read
    // and written, the diagonal is read
    constexpr double vectors_of_a_sweep = 6.;

    const double pairs    = matrices.node_pairs().n_blocks(),
                 nodes    = matrices.node_pairs().n_rows(),
                 gradient = matrices.gradient.pattern().n_blocks(),
                 mass     = matrices.pressure_mass.pattern().n_blocks(),
                 unknowns =
                   system.velocity_rhs.size() + system.pressure_rhs.size();

    // read what the nodes are given, write what they get
    const double node_vector = n_node_numbers * nodes,
                 product     = system.cells.bytes_of_a_product<double>() +
                           2. * node_vector * whole,
                 fast_product = system.cells.bytes_of_a_product<float>() +
                                2. * node_vector * single;
    const double sweep = (pairs - nodes) / 2. * (single + index) +
                         vectors_of_a_sweep * node_vector * single;
    const double preconditioner = gradient * (3. * single + index) +
                                  mass_products * mass * (single + index) +
                                  sweeps * sweep;
    const double cycles = std::floor(iterations / basis_size),
                 rest   = iterations - cycles * basis_size;
    const double basis =
      (cycles * basis_size * basis_size + rest * rest) * unknowns * single;
    return iterations * fast_product +
           (iterations + std::ceil(iterations / basis_size)) * preconditioner +
           basis + (1. + earlier_solutions) * fast_product +
           residuals * product;
  }
} // namespace Catena

#endif

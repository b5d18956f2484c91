#ifndef catena_contrib_benchmarks_memory_traffic_h
#define catena_contrib_benchmarks_memory_traffic_h

#include <catena/flow/flow_matrices.h>

#include <algorithm>
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
   * Bytes that FlowSolver has to move for a solution: every entry and every
   * index of its matrices once for each product and each sweep over them, and
   * the basis of GMRES twice for each of its vectors. What the coarser levels
   * of the multigrid and the other vectors take is left out.
   */
  inline double
  bytes_of_a_solution(const FlowMatrices<3> &matrices, const double iterations)
  {
    constexpr double index = 4., single = 4., whole = 8.;
    constexpr double sweeps = 4., mass_sweeps = 4., earlier_solutions = 4.,
                     residuals = 2.;

    const double velocity = matrices.velocity.pattern().n_blocks(),
                 gradient = matrices.gradient.pattern().n_blocks(),
                 mass     = matrices.pressure_mass.n_nonzero_elements(),
                 unknowns =
                   matrices.velocity_rhs.size() + matrices.pressure_rhs.size();

    const auto product = [&](const double number) {
      return velocity * (9. * number + index) +
             2. * gradient * (3. * number + index);
    };
    const double preconditioner = gradient * (3. * single + index) +
                                  mass_sweeps * mass * (whole + index) +
                                  sweeps * velocity * (single + index);
    const double basis = 2. * iterations / 2. * unknowns * whole;
    return iterations * (product(single) + preconditioner + basis) +
           (1. + earlier_solutions) * product(single) +
           residuals * product(whole);
  }
} // namespace Catena

#endif

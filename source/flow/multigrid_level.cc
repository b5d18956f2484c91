#include <catena/flow/multigrid_level.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * The highest mode can be one of few elements, which the power iteration
     * finds slowly; what lies above the range of the smoother it amplifies.
     */
    constexpr unsigned int n_iterations = 20;
    constexpr double       safety       = 1.2;
  } // namespace



  MultigridLevel::MultigridLevel(NodeMatrix                    new_matrix,
                                 const std::vector<FieldMask> &masks,
                                 const double                  smoothing_range,
                                 LaneEntries                   extra)
    : level_matrix(std::move(new_matrix))
    , extra_entries(std::move(extra))
  {
    for (NodeVector *vector :
         {&solution, &residual, &step, &next_step, &inverse_diagonal})
      reinit(*vector, level_matrix.column_nodes());
    Lanes *const D = lanes(inverse_diagonal);
    for (unsigned int i = 0; i < level_matrix.n_rows(); ++i)
      D[i] = Lanes{} + level_matrix.diagonal(i);
    extra_entries.add_diagonal(D);
    for (unsigned int i = 0; i < level_matrix.n_rows(); ++i)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        D[i][lane] = ((masks[i] >> lane) & 1U) ? 1.f / D[i][lane] : 0.f;
    estimate_eigenvalue();

    const double high = safety * eigenvalue, low = eigenvalue / smoothing_range;
    const double centre = (high + low) / 2., radius = (high - low) / 2.;
    const double ratio = 1. / (2. * centre / radius - radius / centre);
    first_weight       = 1. / centre;
    step_weight        = ratio * radius / centre;
    residual_weight    = 2. * ratio / radius;
  }



  /**
   * Power iteration from numbers that follow from those of the nodes.
   */
  void
  MultigridLevel::estimate_eigenvalue()
  {
    const auto        &nodes = level_matrix.column_nodes();
    const unsigned int n     = level_matrix.n_rows();
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int node = nodes.local_to_global(i);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          lanes(step)[i][lane] =
            lanes(inverse_diagonal)[i][lane] == 0.f ?
              0.f :
              (7919 * node + 104729 * lane) % 1009 / 1009.f - 0.5f;
      }
    for (unsigned int iteration = 0; iteration < n_iterations; ++iteration)
      {
        step.update_ghost_values();
        double square = 0.;
        for (unsigned int i = 0; i < n; ++i)
          lanes(next_step)[i] = level_matrix.row_times(i, lanes(step));
        extra_entries.add_product(lanes(next_step), 1.f, lanes(step));
        for (unsigned int i = 0; i < n; ++i)
          {
            const Lanes value =
              lanes(inverse_diagonal)[i] * lanes(next_step)[i];
            lanes(next_step)[i] = value;
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              square += value[lane] * value[lane];
          }
        eigenvalue =
          std::sqrt(Utilities::MPI::sum(square, nodes.get_mpi_communicator()));
        const float scaling = 1. / eigenvalue;
        for (unsigned int i = 0; i < n; ++i)
          lanes(step)[i] = scaling * lanes(next_step)[i];
      }
  }



  template <typename Function>
  void
  MultigridLevel::take_step(const Function &at_node) const
  {
    step.update_ghost_values();
    const Lanes *const d = lanes(step);
    Lanes *const       r = lanes(residual);
    extra_entries.add_product(r, -1.f, d);
    for (unsigned int i = 0; i < level_matrix.n_rows(); ++i)
      {
        r[i] -= level_matrix.row_times(i, d);
        at_node(i, r[i]);
      }
  }



  void
  MultigridLevel::second_step() const
  {
    Lanes *const x = lanes(solution), *const next = lanes(next_step);
    const Lanes *const d = lanes(step), *const D = lanes(inverse_diagonal);
    take_step([&](const unsigned int i, const Lanes r) {
      next[i] = step_weight * d[i] + residual_weight * D[i] * r;
      x[i] += next[i];
    });
    step.swap(next_step);
  }



  void
  MultigridLevel::smooth_from_zero() const
  {
    Lanes *const x = lanes(solution), *const d = lanes(step);
    const Lanes *const r = lanes(residual), *const D = lanes(inverse_diagonal);
    for (unsigned int i = 0; i < level_matrix.n_rows(); ++i)
      x[i] = d[i] = first_weight * D[i] * r[i];
    second_step();
    take_step([](const unsigned int, const Lanes) {});
  }



  void
  MultigridLevel::smooth_after_step() const
  {
    Lanes *const x = lanes(solution), *const next = lanes(next_step);
    const Lanes *const d = lanes(step), *const D = lanes(inverse_diagonal);
    take_step([&](const unsigned int i, const Lanes r) {
      next[i] = first_weight * D[i] * r;
      x[i] += d[i] + next[i];
    });
    step.swap(next_step);
    second_step();
  }
} // namespace Catena

#include <catena/flow/galerkin_product.h>
#include <catena/flow/node_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Number of nodes for which a dense inverse is cheap.
    constexpr unsigned int n_coarsest = 300;

    constexpr double quadratic_smoothing_range = 10., smoothing_range = 8.;
  } // namespace



  NodeMultigrid::NodeMultigrid(const SparseRows             &matrix,
                               const std::vector<FieldMask> &fine_masks,
                               const SparseRows             &interpolation,
                               const std::vector<FieldMask> &vertex_masks,
                               const MPI_Comm                comm)
  {
    const auto nodes = make_nodes(fine_masks.size(), {&matrix}, comm);
    levels.push_back(std::make_unique<MultigridLevel>(
      NodeMatrix(matrix, nodes), fine_masks, quadratic_smoothing_range));
    SparseRows             prolongation = interpolation;
    std::vector<FieldMask> masks        = vertex_masks;
    while (true)
      {
        const SparseRows product =
          galerkin_product(levels.back()->matrix(), prolongation, masks.size());
        const auto coarse_nodes =
          make_nodes(masks.size(), {&product, &prolongation}, comm);
        prolongations.emplace_back(prolongation, coarse_nodes);
        if (coarse_nodes->size() <= n_coarsest)
          {
            coarse_inverse =
              std::make_unique<CoarseInverse>(product, masks, *coarse_nodes);
            reinit(coarse_solution, *coarse_nodes);
            reinit(coarse_residual, *coarse_nodes);
            return;
          }
        levels.push_back(std::make_unique<MultigridLevel>(
          NodeMatrix(product, coarse_nodes), masks, smoothing_range));
        SmoothedAggregation aggregation(levels.back()->matrix(),
                                        masks,
                                        levels.back()->largest_eigenvalue());
        prolongation = std::move(aggregation.prolongation);
        masks        = std::move(aggregation.masks);
      }
  }



  void
  NodeMultigrid::cycle(const unsigned int l) const
  {
    const MultigridLevel &level       = *levels[l];
    const bool            is_coarsest = l + 1 == levels.size();
    NodeVector           &residual =
      is_coarsest ? coarse_residual : levels[l + 1]->residual;
    NodeVector &solution =
      is_coarsest ? coarse_solution : levels[l + 1]->solution;

    level.smooth_from_zero();
    residual = 0.f;
    prolongations[l].add_transposed(lanes(residual), lanes(level.residual));
    residual.compress(VectorOperation::add);
    if (is_coarsest)
      coarse_inverse->vmult(solution, residual);
    else
      cycle(l + 1);
    solution.update_ghost_values();
    const Lanes *const correction = lanes(solution);
    for (unsigned int i = 0; i < prolongations[l].n_rows(); ++i)
      lanes(level.step)[i] = prolongations[l].row_times(i, correction);
    level.smooth_after_step();
  }



  void
  NodeMultigrid::vmult(VectorType                      &dst,
                       const VectorType                &src,
                       const std::vector<unsigned int> &components,
                       const unsigned int               n_components) const
  {
    const MultigridLevel &finest = *levels.front();
    const unsigned int    n      = finest.matrix().n_rows();
    const double *const   from   = src.begin();
    double *const         to     = dst.begin();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int lane = 0; lane < components.size(); ++lane)
        finest.residual.local_element(n_lanes * i + lane) =
          from[n_components * i + components[lane]];
    cycle(0);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int lane = 0; lane < components.size(); ++lane)
        to[n_components * i + components[lane]] =
          finest.solution.local_element(n_lanes * i + lane);
  }
} // namespace Catena

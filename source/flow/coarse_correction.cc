#include <catena/flow/coarse_correction.h>
#include <catena/flow/galerkin_product.h>
#include <catena/flow/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Number of nodes for which a dense inverse is cheap.
    constexpr unsigned int n_coarsest = 300;

    constexpr double smoothing_range = 8.;

    /// of nodes, from one level to the next
    constexpr double worst_reduction = 0.8;
  } // namespace



  CoarseCorrection::CoarseCorrection(const NodeMatrix &matrix,
                                     const SparseRows &prolongation_rows,
                                     const std::vector<FieldMask> &masks,
                                     const MPI_Comm                comm)
  {
    const SparseRows product =
      galerkin_product(matrix, prolongation_rows, masks.size());
    const auto nodes =
      make_nodes(masks.size(), {&product, &prolongation_rows}, comm);
    prolongation = NodeMatrix(prolongation_rows, nodes);
    if (nodes->size() <= n_coarsest)
      {
        inverse = std::make_unique<CoarseInverse>(product, masks, *nodes);
        reinit(solution, *nodes);
        reinit(right_hand_side, *nodes);
        return;
      }
    level = std::make_unique<MultigridLevel>(NodeMatrix(product, nodes),
                                             masks,
                                             smoothing_range);
    const SmoothedAggregation aggregation(level->matrix(),
                                          masks,
                                          level->largest_eigenvalue());
    const unsigned int        n_coarser =
      Utilities::MPI::sum<unsigned int>(aggregation.masks.size(), comm);
    if (n_coarser < worst_reduction * nodes->size())
      coarser = std::make_unique<CoarseCorrection>(level->matrix(),
                                                   aggregation.prolongation,
                                                   aggregation.masks,
                                                   comm);
  }



  void
  CoarseCorrection::add_to(NodeVector &step, const NodeVector &residual) const
  {
    NodeVector &r = level ? level->residual : right_hand_side;
    NodeVector &x = level ? level->solution : solution;

    r = 0.f;
    prolongation.add_transposed(lanes(r), lanes(residual));
    r.compress(VectorOperation::add);
    if (level)
      {
        level->smooth_from_zero();
        level->step = 0.f;
        if (coarser)
          coarser->add_to(level->step, r);
        level->smooth_after_step();
      }
    else
      inverse->vmult(x, r);

    x.update_ghost_values();
    for (unsigned int i = 0; i < prolongation.n_rows(); ++i)
      lanes(step)[i] += prolongation.row_times(i, lanes(x));
  }
} // namespace Catena

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
    prolongation = Prolongation(prolongation_rows, *nodes);
    if (nodes->size() <= n_coarsest)
      {
        inverse = std::make_unique<CoarseInverse>(product, masks, *nodes);
        reinit(coarse_solution, *nodes);
        reinit(coarse_residual, *nodes);
        return;
      }
    const NodeMatrix coarse_matrix(product, nodes);
    level = std::make_unique<MultigridLevel>(coarse_matrix, masks);
    const SmoothedAggregation aggregation(coarse_matrix, masks);
    const unsigned int        n_coarser =
      Utilities::MPI::sum<unsigned int>(aggregation.masks.size(), comm);
    if (n_coarser < worst_reduction * nodes->size())
      coarser = std::make_unique<CoarseCorrection>(coarse_matrix,
                                                   aggregation.prolongation,
                                                   aggregation.masks,
                                                   comm);
  }



  void
  CoarseCorrection::correct(NodeVector       &solution,
                            const NodeVector &residual) const
  {
    NodeVector &r = level ? level->residual : coarse_residual;
    NodeVector &x = level ? level->solution : coarse_solution;

    r = 0.f;
    prolongation.add_transposed_product(lanes(r), lanes(residual));
    r.compress(VectorOperation::add);
    if (level)
      {
        level->smooth_from_zero();
        if (coarser)
          coarser->correct(x, r);
        level->smooth_corrected();
      }
    else
      inverse->vmult(x, r);

    x.update_ghost_values();
    prolongation.add_product(lanes(solution), lanes(x));
  }
} // namespace Catena

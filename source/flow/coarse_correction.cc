#include <catena/flow/coarse_correction.h>
#include <catena/flow/galerkin_product.h>
#include <catena/flow/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

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



  CoarseCorrection::CoarseCorrection(
    const std::vector<FieldOperator> &operators,
    const std::vector<FieldMask>     &masks,
    const MPI_Comm                    comm)
  {
    std::vector<SparseRows>              products;
    std::vector<Prolongation::FieldRows> prolongations;
    std::vector<const SparseRows *>      all_rows;
    for (const FieldOperator &some : operators)
      {
        products.push_back(
          galerkin_product(some.matrix.rows, *some.prolongation, masks.size()));
        prolongations.push_back({some.matrix.fields, some.prolongation});
        all_rows.push_back(some.prolongation);
      }
    for (const SparseRows &product : products)
      all_rows.push_back(&product);
    const auto nodes = make_nodes(masks.size(), all_rows, comm);
    prolongation     = Prolongation(prolongations, *nodes);
    if (operators.size() == 1 && nodes->size() <= n_coarsest)
      {
        inverse =
          std::make_unique<CoarseInverse>(products.front(), masks, *nodes);
        reinit(coarse_solution, *nodes);
        reinit(coarse_residual, *nodes);
        return;
      }

    std::vector<FieldMatrix> matrices;
    for (unsigned int g = 0; g < operators.size(); ++g)
      {
        products[g].make_local(*nodes);
        matrices.push_back(
          {operators[g].matrix.fields, NodeRows(products[g], nodes)});
      }
    level = std::make_unique<MultigridLevel>(matrices, masks);
    for (const FieldMatrix &matrix : matrices)
      {
        std::vector<FieldMask> field_masks;
        for (const FieldMask mask : masks)
          field_masks.push_back(mask & matrix.fields);
        const SmoothedAggregation aggregation(matrix.rows, field_masks);
        const unsigned int        n_without =
          std::count(field_masks.begin(), field_masks.end(), 0);
        const unsigned int n_nodes = Utilities::MPI::sum<unsigned int>(
                             field_masks.size() - n_without, comm),
                           n_coarser = Utilities::MPI::sum<unsigned int>(
                             aggregation.masks.size(), comm);
        if (n_coarser < worst_reduction * n_nodes)
          coarser.emplace_back(
            std::vector<FieldOperator>{{matrix, &aggregation.prolongation}},
            aggregation.masks,
            comm);
      }
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
        for (const CoarseCorrection &correction : coarser)
          correction.correct(x, r);
        level->smooth_corrected();
      }
    else
      inverse->vmult(x, r);

    x.update_ghost_values();
    prolongation.add_product(lanes(solution), lanes(x));
  }
} // namespace Catena

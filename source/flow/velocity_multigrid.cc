#include <catena/flow/velocity_multigrid.h>
#include <catena/flow/vertex_interpolation.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr double smoothing_range = 10.;

    /// The rows of this rank in single precision.
    SparseRows
    owned_rows(const BlockMatrix<1> &matrix)
    {
      const BlockPattern &pattern = matrix.pattern();
      SparseRows          rows;
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        {
          for (unsigned int k = pattern.row_start(row);
               k < pattern.row_start(row + 1);
               ++k)
            rows.add(pattern.column_nodes().local_to_global(
                       pattern.local_columns()[k]),
                     *matrix.block(k));
          rows.end_row();
        }
      return rows;
    }
  } // namespace



  template <int dim>
  VelocityMultigrid<dim>::VelocityMultigrid(
    const MovingMesh<dim>                &mesh,
    const std::vector<NodeCoupling<dim>> &couplings,
    const PreconditionerMatrices<dim>    &matrices)
  {
    const MPI_Comm   comm = mesh.communicator();
    const SparseRows shared_rows =
      owned_rows(matrices.component_matrices.front().matrix);
    const auto nodes = make_nodes(shared_rows.size(), {&shared_rows}, comm);
    const NodeMatrix shared(shared_rows, nodes);

    std::vector<FieldMask>              masks(shared_rows.size(), 0);
    std::vector<LaneEntries::FieldRows> others;
    for (const auto &group : matrices.component_matrices)
      {
        const VertexInterpolation<dim> interpolation(mesh,
                                                     couplings,
                                                     group.components);
        for (unsigned int i = 0; i < masks.size(); ++i)
          masks[i] |= interpolation.node_masks[i];

        const auto add_correction = [&](const NodeMatrix &matrix) {
          corrections.emplace_back(matrix,
                                   interpolation.prolongation,
                                   interpolation.vertex_masks,
                                   comm);
        };
        if (&group == &matrices.component_matrices.front())
          {
            add_correction(shared);
            continue;
          }
        FieldMask fields = 0;
        for (const unsigned int component : group.components)
          fields |= 1U << component;
        SparseRows rows = owned_rows(group.matrix);
        add_correction(NodeMatrix(rows, nodes));
        others.push_back({fields, std::move(rows)});
      }
    finest = std::make_unique<MultigridLevel>(
      shared,
      masks,
      smoothing_range,
      LaneEntries(shared, shared_rows, others, masks));
  }



  template <int dim>
  void
  VelocityMultigrid<dim>::vmult(VectorType &dst, const VectorType &src) const
  {
    const unsigned int  n    = finest->matrix().n_rows();
    const double *const from = src.begin();
    double *const       to   = dst.begin();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        finest->residual.local_element(n_lanes * i + d) = from[dim * i + d];
    finest->smooth_from_zero();
    finest->step = 0.f;
    for (const CoarseCorrection &correction : corrections)
      correction.add_to(finest->step, finest->residual);
    finest->smooth_after_step();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        to[dim * i + d] = finest->solution.local_element(n_lanes * i + d);
  }



  template class VelocityMultigrid<2>;
  template class VelocityMultigrid<3>;
} // namespace Catena

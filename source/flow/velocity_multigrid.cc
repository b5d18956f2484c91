#include <catena/flow/velocity_multigrid.h>
#include <catena/flow/vertex_interpolation.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  VelocityMultigrid<dim>::VelocityMultigrid(
    const MovingMesh<dim>                &mesh,
    const std::vector<NodeCoupling<dim>> &couplings,
    const PreconditionerMatrices<dim>    &matrices)
  {
    const MPI_Comm   comm = mesh.communicator();
    const NodeMatrix shared(matrices.node_pairs(),
                            matrices.component_matrices.front().entries);

    std::vector<FieldMask>                masks(shared.n_rows(), 0);
    std::vector<LaneEntries::FieldMatrix> others;
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
        others.push_back(
          {fields, NodeMatrix(matrices.node_pairs(), group.entries)});
        add_correction(others.back().matrix);
      }
    finest =
      std::make_unique<MultigridLevel>(shared,
                                       masks,
                                       LaneEntries(shared, others, masks));
  }



  template <int dim>
  void
  VelocityMultigrid<dim>::vmult(FastVectorType       &dst,
                                const FastVectorType &src) const
  {
    const unsigned int n    = finest->n_nodes();
    const float *const from = src.begin();
    float *const       to   = dst.begin();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        finest->residual.local_element(n_lanes * i + d) = from[dim * i + d];
    finest->smooth_from_zero();
    for (const CoarseCorrection &correction : corrections)
      correction.correct(finest->solution, finest->residual);
    finest->smooth_corrected();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        to[dim * i + d] = finest->solution.local_element(n_lanes * i + d);
  }



  template class VelocityMultigrid<2>;
  template class VelocityMultigrid<3>;
} // namespace Catena

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
    std::vector<std::vector<unsigned int>> groups;
    std::vector<FieldMask>                 fields;
    for (const auto &group : matrices.component_matrices)
      {
        groups.push_back(group.components);
        fields.push_back(0);
        for (const unsigned int component : group.components)
          fields.back() |= 1U << component;
      }
    const VertexInterpolation<dim> interpolation(mesh, couplings, groups);

    std::vector<FieldMatrix>                     field_matrices;
    std::vector<CoarseCorrection::FieldOperator> operators;
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        field_matrices.push_back(
          {fields[g], matrices.rows(matrices.component_matrices[g])});
        operators.push_back(
          {field_matrices.back(), &interpolation.prolongations[g]});
      }
    correction = std::make_unique<CoarseCorrection>(operators,
                                                    interpolation.vertex_masks,
                                                    mesh.communicator());
    finest     = std::make_unique<MultigridLevel>(field_matrices,
                                              interpolation.node_masks);
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
    correction->correct(finest->solution, finest->residual);
    finest->smooth_corrected();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        to[dim * i + d] = finest->solution.local_element(n_lanes * i + d);
  }



  template class VelocityMultigrid<2>;
  template class VelocityMultigrid<3>;
} // namespace Catena

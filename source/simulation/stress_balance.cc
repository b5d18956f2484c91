#include <catena/conformation/strain_rate_projection.h>
#include <catena/flow/stress_prediction.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/exponential.h>
#include <catena/simulation/stress_balance.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  StressBalance<dim>::StressBalance(const MovingMesh<dim> &mesh,
                                    const Giesekus<dim>   &model,
                                    const Level<dim>      &level,
                                    const VectorType      &last_velocity)
    : mesh(mesh)
    , model(model)
    , level(level)
  {
    if (StressPrediction<dim>::numerical_viscosity(model) > 0.)
      smooth_strain_rate =
        StrainRateProjection<dim>(mesh).project(last_velocity);
  }



  template <int dim>
  void
  StressBalance<dim>::evaluate(
    const typename MovingMesh<dim>::Cell &cell,
    const CellValues<dim>                &values,
    std::vector<StressCoefficients<dim>> &coefficients) const
  {
    const double theta = StressPrediction<dim>::numerical_viscosity(model),
                 beta  = model.solvent_viscosity();
    const auto s       = vertex_tensors<dim>(cell, level.log_conformation);
    const auto u       = node_vectors<dim>(cell, level.flow.velocity);

    StressCoefficients<dim> newtonian;
    newtonian.viscosity = unit_symmetric_tensor<dim>();
    coefficients.assign(values.points().size(), newtonian);
    for (const auto &pack : values.packs())
      {
        SymmetricTensor<2, dim, Pack> c_p =
          exponential(interpolate<dim>(pack, s));
        // the viscosity, all that is needed of other cells, does not depend on
        // it
        if (cell.owned && !level.unresolved_conformation.empty())
          c_p += level.unresolved_conformation.get(cell, pack);
        auto T = model.modulus() * (c_p - unit_symmetric_tensor<dim, Pack>()) +
                 (2. * (beta + theta)) *
                   symmetrize(gradients_at<dim>(values, pack, u));
        if (!smooth_strain_rate.empty())
          T -= (2. * theta) *
               interpolate<dim>(pack,
                                vertex_tensors<dim>(cell, smooth_strain_rate));
        for (unsigned int k = 0; k < pack.n_points; ++k)
          coefficients[pack.first + k].known_stress = lane<dim>(T, k);
      }
  }



  template <int dim>
  PointTensors<dim>
  StressBalance<dim>::sum(const PointTensors<dim> &unresolved,
                          const VectorType        &e) const
  {
    PointTensors<dim> result(mesh);
    CellValues<dim>   values;
    for (const auto &cell : mesh.cells())
      {
        if (!cell.owned)
          continue;
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        const auto nodes = node_vectors<dim>(cell, e);
        for (const auto &pack : values.packs())
          {
            SymmetricTensor<2, dim, Pack> c =
              (2. / model.modulus()) *
              symmetrize(gradients_at<dim>(values, pack, nodes));
            if (!unresolved.empty())
              c += unresolved.get(cell, pack);
            result.set(cell, pack, c);
          }
      }
    return result;
  }



  template class StressBalance<2>;
  template class StressBalance<3>;
} // namespace Catena

#include <catena/simulation/extrapolation.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// The weighted sum of a field at two instants.
    VectorType
    combine(const TwoLevelWeights &weights,
            const VectorType      &now,
            const VectorType      &before)
    {
      VectorType result = now;
      if (weights.b1 != 0.)
        result.sadd(weights.b0, weights.b1, before);
      result.update_ghost_values();
      return result;
    }
  } // namespace



  template <int dim>
  VectorType
  mesh_velocity(const State<dim> &state,
                const Level<dim> &next,
                const TimeStep   &step)
  {
    const BdfCoefficients bdf    = step.bdf();
    VectorType            result = next.positions;
    result.sadd(bdf.a0 / step.dt, bdf.a1 / step.dt, state.now.positions);
    if (bdf.a2 != 0.)
      result.add(bdf.a2 / step.dt, state.before.positions);
    result.update_ghost_values();
    return result;
  }



  template <int dim>
  FlowFields<dim>
  extrapolated_flow(const State<dim> &state, const TimeStep &step)
  {
    const TwoLevelWeights weights = step.extrapolation();
    return combination(weights.b0,
                       state.now.flow,
                       weights.b1,
                       state.before.flow);
  }



  template <int dim>
  std::vector<VectorType>
  extrapolated_log_conformation(const State<dim> &state, const TimeStep &step)
  {
    const TwoLevelWeights weights = step.extrapolation();
    const auto           &now     = state.now.log_conformation;
    const auto           &before  = state.before.log_conformation;
    // sized first: a vector copied when the list grows loses its ghost values
    std::vector<VectorType> result(now.size());
    for (unsigned int k = 0; k < now.size(); ++k)
      result[k] =
        combine(weights, now[k], weights.b1 != 0. ? before[k] : now[k]);
    return result;
  }



  template VectorType
  mesh_velocity<2>(const State<2> &, const Level<2> &, const TimeStep &);
  template FlowFields<2>
  extrapolated_flow<2>(const State<2> &, const TimeStep &);
  template std::vector<VectorType>
  extrapolated_log_conformation<2>(const State<2> &, const TimeStep &);
  template VectorType
  mesh_velocity<3>(const State<3> &, const Level<3> &, const TimeStep &);
  template FlowFields<3>
  extrapolated_flow<3>(const State<3> &, const TimeStep &);
  template std::vector<VectorType>
  extrapolated_log_conformation<3>(const State<3> &, const TimeStep &);
} // namespace Catena

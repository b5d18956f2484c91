#include <catena/base/exceptions.h>
#include <catena/conformation/conformation_change.h>
#include <catena/mesh/cell_fields.h>
#include <catena/simulation/step_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    unsigned int
    n_repelling(const Level<dim> &level)
    {
      const std::vector<double> &forces = level.flow.contact_forces;
      return std::count_if(forces.begin(),
                           forces.end(),
                           [](const double force) { return force > 0.; });
    }



    /// Has a contact opened or closed in this step or in the last one?
    template <int dim>
    bool
    contacts_changed(const State<dim> &state, const Level<dim> &next)
    {
      return n_repelling(next) != n_repelling(state.now) ||
             n_repelling(state.now) != n_repelling(state.before);
    }



    /// Where the two differ most, or are not finite.
    template <int dim>
    Point<dim>
    place_of_largest_change(const MovingMesh<dim>         &mesh,
                            const std::vector<VectorType> &s,
                            const std::vector<VectorType> &s_hat)
    {
      double       largest = -1.;
      unsigned int vertex  = 0;
      for (const auto i : mesh.owned_scalars())
        {
          double change = 0.;
          for (unsigned int k = 0; k < s.size(); ++k)
            change = std::max(change, std::abs(s[k](i) - s_hat[k](i)));
          for (unsigned int k = 0; k < s.size(); ++k)
            if (!std::isfinite(s[k](i)))
              change = std::numeric_limits<double>::max();
          if (change > largest)
            {
              largest = change;
              vertex  = i;
            }
        }
      Point<dim> place;
      if (largest >= 0.)
        place =
          node_position<dim>(mesh.positions(), mesh.node_of_vertex(vertex));
      const auto owner =
        Utilities::MPI::min_max_avg(largest, mesh.communicator()).max_index;
      return Utilities::MPI::broadcast(mesh.communicator(), place, owner);
    }



    /// Of the points of the particles' surfaces, over the step.
    template <int dim>
    double
    error_of_positions(const State<dim> &state,
                       const Level<dim> &next,
                       const TimeStep   &step)
    {
      const TwoLevelWeights weights = step.adams_bashforth();
      const auto difference = [&](const auto member, const unsigned int i) {
        const auto &now = state.now.flow.motions[i].*member;
        auto        result =
          weights.b0 * now - (now + next.flow.motions[i].*member) / 2.;
        if (weights.b1 != 0.)
          result += weights.b1 * (state.before.flow.motions[i].*member);
        return result.norm();
      };
      // errors (2 dt + 3 dt') and -dt, times dt^2/12 and the third derivative
      const double share = (2. * step.dt + 3. * step.previous_dt) /
                           (3. * (step.dt + step.previous_dt));
      const auto &particles = state.discretization.mesh->scene().particles;
      double      largest   = 0.;
      for (unsigned int i = 0; i < particles.size(); ++i)
        largest =
          std::max(largest,
                   difference(&RigidMotion<dim>::velocity, i) +
                     particles[i].radius *
                       difference(&RigidMotion<dim>::angular_velocity, i));
      return share * largest;
    }
  } // namespace



  template <int dim>
  StepError
  step_error(const State<dim>              &state,
             const Level<dim>              &next,
             const std::vector<VectorType> &predicted,
             const TimeStep                &step,
             const bool                     held,
             const bool                     on_a_new_mesh)
  {
    const double       positions = held || contacts_changed(state, next) ?
                                     0. :
                                     error_of_positions(state, next, step);
    ConformationChange change;
    if (!next.log_conformation.empty())
      change = conformation_change<dim>(*state.discretization.mesh,
                                        next.log_conformation,
                                        predicted);
    if (!std::isfinite(next.flow.velocity.l2_norm()) ||
        !std::isfinite(next.flow.pressure.l2_norm()))
      throw SolverError("The flow has values that are not finite: use a "
                        "smaller 'Time/Time step' or a finer mesh.");
    // NaN is not followed either
    const bool is_followed =
      on_a_new_mesh ?
        change.largest <= StepError::failing_change_on_a_new_mesh &&
          change.mean <= StepError::failing_change :
        change.largest <= StepError::failing_change;
    if (!is_followed || !std::isfinite(change.mean))
      {
        std::ostringstream text;
        text << "The log-conformation is off its extrapolation by "
             << change.largest << " near the point "
             << place_of_largest_change<dim>(*state.discretization.mesh,
                                             next.log_conformation,
                                             predicted)
             << ": use a smaller 'Time/Time step' or a finer mesh.";
        throw SolverError(text.str());
      }
    return {step.dt * std::max(positions, change.mean), change.largest};
  }



  template StepError
  step_error<2>(const State<2> &,
                const Level<2> &,
                const std::vector<VectorType> &,
                const TimeStep &,
                const bool,
                const bool);
  template StepError
  step_error<3>(const State<3> &,
                const Level<3> &,
                const std::vector<VectorType> &,
                const TimeStep &,
                const bool,
                const bool);
} // namespace Catena

#ifndef catena_benchmarks_recorded_steps_h
#define catena_benchmarks_recorded_steps_h

#include <catena/flow/flow_solver.h>
#include <catena/flow/stress_prediction.h>
#include <catena/simulation/simulation.h>

#include <deque>
#include <vector>

/**
 * What the flow of a time step was solved from, and the motions it gave. Gaps
 * that were held are not; what held them acts from outside.
 */
struct RecordedStep
{
  Catena::Configuration<3>            configuration;
  Catena::TimeStep                    step;
  Catena::VectorType                  positions;
  std::vector<Catena::VectorType>     old, older;
  Catena::PointTensors<3>             old_unresolved, older_unresolved;
  Catena::StressPrediction<3>::Motion fluid_motion;
  Catena::FlowFields<3>               first_guess;
  std::vector<double>                 forces;
  std::vector<Catena::RigidMotion<3>> motions;

  Catena::StressPrediction<3>
  stress(const Catena::MovingMesh<3>                    &mesh,
         const Catena::GiesekusParameters               &fluid,
         Catena::StressPrediction<3>::KnownConformation &storage) const
  {
    return Catena::StressPrediction<3>(mesh,
                                       Catena::Giesekus<3>(fluid),
                                       step,
                                       {old, old_unresolved},
                                       {older, older_unresolved},
                                       fluid_motion,
                                       storage);
  }
};



/**
 * The step to the present state of @p simulation.
 * @param older the level two steps ago
 */
inline RecordedStep
record(const Catena::Simulation<3> &simulation,
       const Catena::Level<3>      &older,
       const Catena::TimeStep      &step)
{
  const Catena::Level<3> &now = simulation.current_state().now,
                         &old = simulation.current_state().before;
  RecordedStep result;
  result.configuration    = now.configuration;
  result.step             = step;
  result.positions        = now.positions;
  result.old              = old.log_conformation;
  result.older            = older.log_conformation;
  result.old_unresolved   = old.unresolved_conformation;
  result.older_unresolved = older.unresolved_conformation;
  result.motions          = now.flow.motions;

  const auto w       = step.extrapolation();
  result.first_guess = Catena::combination(w.b0, old.flow, w.b1, older.flow);
  result.first_guess.contact_forces.clear();

  const auto bdf    = step.bdf();
  auto      &motion = result.fluid_motion;
  motion.convection = result.first_guess.velocity;
  motion.convection.add(-bdf.a0 / step.dt, now.positions);
  motion.convection.add(-bdf.a1 / step.dt, old.positions);
  motion.convection.add(-bdf.a2 / step.dt, older.positions);
  motion.convection.update_ghost_values();
  motion.last_velocity = old.flow.velocity;
  motion.last_velocity.update_ghost_values();

  result.forces = simulation.present_forces();
  return result;
}



/**
 * The last @p n_steps steps until @p strain; fewer if there is a new mesh.
 */
inline std::deque<RecordedStep>
recorded_steps(Catena::Simulation<3> &simulation,
               const double           strain,
               const unsigned int     n_steps)
{
  std::deque<RecordedStep> steps;
  simulation.initialize();
  Catena::TimeStep step;
  Catena::Level<3> older;
  while (simulation.strain() < strain - 1e-9)
    {
      older                           = simulation.current_state().before;
      const bool               held   = simulation.held_in_place();
      const Catena::StepReport report = simulation.advance();
      step                            = step.next(report.dt);
      if (report.remeshed)
        steps.clear();
      else if (!held && !older.log_conformation.empty())
        steps.push_back(record(simulation, older, step));
      if (steps.size() > n_steps)
        steps.pop_front();
    }
  return steps;
}

#endif

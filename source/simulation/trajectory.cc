#include <catena/simulation/trajectory.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// F_S = 6 pi eta0 gamma a^2, the unit in which forces are written.
    constexpr double stokes_force = 6. * numbers::PI;

    /// distances of all pairs are written for so many particles
    constexpr unsigned int max_with_distances = 4;

    const std::array<std::string, 3> axes = {{"x", "y", "z"}};

    std::string
    name(const std::string &quantity, const unsigned int particle)
    {
      return quantity + "_" + std::to_string(particle);
    }
  } // namespace



  template <int dim>
  Trajectory<dim>::Trajectory(const std::string     &path,
                              const Simulation<dim> &simulation,
                              const MPI_Comm         communicator)
    : simulation(simulation)
    , table(path, communicator)
    , has_gap(std::isfinite(simulation.contact_set().smallest_gap(
        simulation.current_state().now.configuration)))
  {
    declare_columns();
  }



  template <int dim>
  Trajectory<dim>::Trajectory(const std::string               &path,
                              const Simulation<dim>           &simulation,
                              const MPI_Comm                   communicator,
                              const TrajectoryTable::Position &position)
    : simulation(simulation)
    , table(path, communicator, position)
    , has_gap(std::isfinite(simulation.contact_set().smallest_gap(
        simulation.current_state().now.configuration)))
  {
    declare_columns();
  }



  template <int dim>
  void
  Trajectory<dim>::declare_columns()
  {
    const unsigned int n =
      simulation.current_state().now.configuration.centres.size();
    table.declare("strain");
    table.declare("dt", "1/gamma");
    table.declare("step_error");
    if (simulation.initial_scene().line)
      table.declare("theta", "deg");
    if (has_gap)
      table.declare("gap", "2a");
    for (unsigned int i = 0; i < n && n <= max_with_distances; ++i)
      for (unsigned int j = 0; j < i; ++j)
        table.declare("distance_" + std::to_string(j) + "_" + std::to_string(i),
                      "a");
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int d = 0; d < dim; ++d)
          table.declare(name(axes[d], i), "a");
        for (unsigned int d = 0; d < dim; ++d)
          table.declare(name("u" + axes[d], i), "a gamma");
        for (unsigned int d = (dim == 2 ? 2 : 0); d < 3; ++d)
          table.declare(d == 2 ? name("omega", i) : name("omega" + axes[d], i),
                        "gamma");
        for (unsigned int d = 0; d < dim; ++d)
          table.declare(name("F" + axes[d], i), "F_S");
      }
    if (simulation.initial_scene().pressure_driven())
      table.declare("pressure_drop", "eta0 gamma");
    table.declare("F_r", "F_S");
    table.declare("held_contacts");
    table.declare("smallest_eigenvalue_c");
    table.declare("largest_trace_tau", "G");
    table.declare("largest_log_c");
    table.declare("mesh_quality");
    table.declare("elements");
    table.declare("remeshed");
    table.declare("flow_iterations");
    table.declare("conformation_iterations");
    table.declare("seconds", "s");
  }



  template <int dim>
  void
  Trajectory<dim>::add_particles()
  {
    const Level<dim>          &now    = simulation.current_state().now;
    const RigidBodies<dim>    &bodies = simulation.rigid_bodies();
    const std::vector<double> &forces = simulation.external_forces(now.time);
    const auto                &x      = now.configuration.centres;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        for (unsigned int j = 0; j < i && x.size() <= max_with_distances; ++j)
          table.add("distance_" + std::to_string(j) + "_" + std::to_string(i),
                    x[i].distance(x[j]));
        const RigidMotion<dim> &motion = now.flow.motions[i];
        Tensor<1, dim>          force;
        const auto              range = bodies.range(i);
        for (unsigned int k = range.first; k < range.second; ++k)
          if (!bodies.unknown(k).rotation)
            force[bodies.unknown(k).axis] =
              bodies.is_fixed(i) ? now.flow.reactions[k] : forces[k];
        for (unsigned int d = 0; d < dim; ++d)
          {
            table.add(name(axes[d], i), x[i][d]);
            table.add(name("u" + axes[d], i), motion.velocity[d]);
            table.add(name("F" + axes[d], i), force[d] / stokes_force);
          }
        for (unsigned int d = (dim == 2 ? 2 : 0); d < 3; ++d)
          table.add(d == 2 ? name("omega", i) : name("omega" + axes[d], i),
                    motion.angular_velocity[d]);
      }
  }



  /**
   * F_r is the mean over the gaps that are held: that of each gap of a string,
   * whichever part of the box is meshed.
   */
  template <int dim>
  void
  Trajectory<dim>::add_contacts()
  {
    const Level<dim>          &now    = simulation.current_state().now;
    const std::vector<double> &forces = now.flow.contact_forces;
    if (has_gap)
      table.add("gap",
                simulation.contact_set().smallest_gap(now.configuration));
    if (simulation.initial_scene().pressure_driven())
      table.add("pressure_drop", now.flow.pressure_drop);
    const auto   n_held = std::count_if(forces.begin(),
                                      forces.end(),
                                      [](const double f) { return f > 0.; });
    const double sum    = std::accumulate(forces.begin(), forces.end(), 0.);
    table.add("F_r", n_held > 0 ? sum / n_held / stokes_force : 0.);
    table.add("held_contacts", n_held);
  }



  template <int dim>
  void
  Trajectory<dim>::record(const StepReport &step)
  {
    const Level<dim> &now = simulation.current_state().now;
    table.add("strain", now.time);
    table.add("dt", step.dt);
    table.add("step_error", step.error.local);
    if (simulation.initial_scene().line)
      table.add("theta", now.configuration.frame_angle * 180. / numbers::PI);
    add_particles();
    add_contacts();
    table.add("smallest_eigenvalue_c", step.extremes.smallest_eigenvalue);
    table.add("largest_trace_tau", step.extremes.largest_trace);
    table.add("largest_log_c", step.extremes.largest_log);
    table.add("mesh_quality", simulation.mesh().quality());
    table.add("elements", simulation.mesh().n_global_cells());
    table.add("remeshed", step.remeshed ? 1. : 0.);
    table.add("flow_iterations", step.flow_iterations);
    table.add("conformation_iterations", step.conformation_iterations);
    table.add("seconds", step.seconds);
    table.write_row();
  }



  template class Trajectory<2>;
  template class Trajectory<3>;
} // namespace Catena

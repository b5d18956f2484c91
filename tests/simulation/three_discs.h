#ifndef catena_tests_simulation_three_discs_h
#define catena_tests_simulation_three_discs_h

#include <catena/simulation/simulation.h>

#include <array>
#include <cmath>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    /**
     * Three discs of a string in a small box, the middle one on the axis of
     * the rotational symmetry, far enough apart not to touch.
     */
    inline Scene<2>
    three_discs()
    {
      const double distance = 2.6, angle = dealii::numbers::PI / 18.;
      Scene<2>     scene;
      scene.length    = 12.;
      scene.height    = 6.;
      scene.symmetry  = Symmetry::quarter;
      scene.particles = {{dealii::Point<2>(), 1., true},
                         {dealii::Point<2>(distance * std::cos(angle),
                                           distance * std::sin(angle))}};
      scene.line      = {{{1, 1}}};
      return scene;
    }



    /// The same, so close that they soon come to a smallest gap of 0.11.
    inline Scene<2>
    close_discs()
    {
      Scene<2> scene = three_discs();
      scene.particles[1].centre *= 2.35 / 2.6;
      return scene;
    }



    /**
     * A Giesekus fluid on a mesh with elements of size @p h, never remeshed
     * unless it is asked for, with tight solvers.
     */
    inline SimulationParameters
    three_discs_parameters(const double h, const double dt)
    {
      SimulationParameters parameters;
      parameters.fluid.giesekus.weissenberg_number = 1.;
      parameters.fluid.giesekus.mobility_parameter = 0.1;
      parameters.minimal_gap                       = 0.001;
      parameters.step_control.time_step            = dt;

      parameters.mesh.elements_on_equator =
        std::lround(2. * dealii::numbers::PI / h);
      parameters.mesh.elements_across_gap = 1;
      parameters.mesh.growth              = h;
      parameters.mesh.maximal_size        = 1.25 * h;
      parameters.remesh_quality           = 0.01;
      parameters.remesh_gap               = 0.;

      parameters.flow_solver.tolerance         = 1e-10;
      parameters.conformation_solver.tolerance = 1e-12;
      return parameters;
    }



    /// The numbers that describe the discs at an instant.
    struct DiscState
    {
      std::array<double, 2> position; ///< of the outer disc
      std::array<double, 2> velocity;
      std::array<double, 2> spins; ///< of the middle and of the outer disc
    };



    inline DiscState
    state_of_discs(const Simulation<2> &simulation)
    {
      const auto &now     = simulation.current_state().now;
      const auto &centre  = now.configuration.centres[1];
      const auto &motions = now.flow.motions;
      return {{{centre[0], centre[1]}},
              {{motions[1].velocity[0], motions[1].velocity[1]}},
              {{motions[0].angular_velocity[2],
                motions[1].angular_velocity[2]}}};
    }



    inline double
    distance(const std::array<double, 2> &a, const std::array<double, 2> &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1]);
    }
  } // namespace Tests
} // namespace Catena

#endif

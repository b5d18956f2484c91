// Two spheres in a Newtonian fluid approach each other, meet at the smallest
// gap, turn about each other while it is held, and are let go when the force
// turns to attraction: distance, angle, spin and force follow the trajectory
// computed from the exact mobilities. Half of a box of four times the paper's
// size is meshed, with meshes between M1 and M2 of the paper.
//
// The errors have two parts, both measured at strain 3. That of the time step
// 0.0625 is of second order (claimed below) and makes 0.04 degrees in 22. That
// of the mesh makes 0.05 degrees here and 0.02 degrees on M2; it is the lag of
// a pair that turns a little too slowly at the start, when the exact velocity
// is a small difference. The box changes the angle by less than 0.02 % of that.

#include <catena/simulation/simulation.h>

#include <iomanip>

#include "spheres_in_a_line.h"

using namespace dealii;
using namespace Catena;

struct Instant
{
  double strain, distance, degrees, spin, force;
  bool   held;
};

/// Distance and angle of the pair, from 0 to 180 degrees.
Instant
instant(const Simulation<3> &simulation)
{
  const Level<3> &now     = simulation.current_state().now;
  const auto     &centres = now.configuration.centres;
  Tensor<1, 3>    line    = Tensor<1, 3>(centres[0]);
  line -= centres.size() == 2 ? Tensor<1, 3>(centres[1]) : -line;

  Instant result;
  result.strain   = now.time;
  result.distance = line.norm();
  result.degrees  = std::atan2(line[1], line[0]) * 180. / numbers::PI;
  result.spin     = now.flow.motions[0].angular_velocity[2];
  result.force    = now.flow.contact_forces.empty() ?
                      0. :
                      now.flow.contact_forces[0] / (6. * numbers::PI);
  result.held     = !now.flow.contact_forces.empty();
  return result;
}



std::vector<Instant>
trajectory(const Symmetry        symmetry,
           const MeshParameters &mesh,
           const double          dt,
           const double          final_strain)
{
  const Tests::Line    line{2, 3., 10., 4., symmetry};
  SimulationParameters parameters;
  parameters.fluid = FluidModel::newtonian;
  parameters.mesh  = mesh;
  parameters.mesh.maximal_size *= line.box;
  parameters.time_step             = dt;
  parameters.final_strain          = final_strain;
  parameters.flow_solver.tolerance = 1e-8;

  Simulation<3> simulation(line.scene(), parameters, MPI_COMM_WORLD);
  simulation.initialize();
  std::vector<Instant> result{instant(simulation)};
  while (simulation.strain() < final_strain - 1e-9)
    {
      simulation.advance();
      result.push_back(instant(simulation));
    }
  return result;
}



void
claim_exact_trajectory(Tests::Claims &claims)
{
  const double               dt = 0.0625;
  const std::vector<Instant> computed =
    trajectory(Symmetry::half, Tests::resolution(40, 2), dt, 4.875);

  // all rows of the table that are instants of the run
  const Tests::Table table = Tests::read_table("newtonian_trajectories.csv");
  double distance = 0., angle = 0., spin = 0., force = 0., held = 0.,
         meeting      = 0.;
  unsigned int n_free = 0, n_held = 0;
  std::cout << "  strain  distance   degrees    spin      force\n"
            << std::fixed << std::setprecision(5);
  for (unsigned int row = 0; row < table.n_rows; ++row)
    {
      if (table.text.at("case")[row] != "pair rmin=2.04 noforce")
        continue;
      const double strain = table["strain"][row];
      if (table.text.at("phase")[row] == "free")
        meeting = strain;
      const unsigned int step = std::lround(strain / dt);
      if (std::abs(step * dt - strain) > 1e-6)
        continue;

      const Instant &now         = computed.at(step);
      const double   exact_r     = table["sep_over_a"][row],
                   exact_degrees = table["theta_deg"][row],
                   exact_spin    = table["omega_outer_or_both"][row],
                   exact_force   = table["Fr_over_6pi_eta_a2_gammadot"][row];
      std::cout << ' ' << now.strain << ' ' << now.distance << ' '
                << now.degrees << ' ' << now.spin << ' ' << now.force
                << "\n  exact   " << exact_r << ' ' << exact_degrees << ' '
                << exact_spin << ' ' << exact_force << '\n';
      spin = std::max(spin, std::abs(now.spin / exact_spin - 1.));
      if (strain > 0.)
        angle =
          std::max(angle,
                   std::abs((now.degrees - 10.) / (exact_degrees - 10.) - 1.));
      if (table.text.at("phase")[row] == "constrained")
        {
          ++n_held;
          held  = std::max(held, std::abs(now.distance - 2.04));
          force = std::max(force, std::abs(now.force / exact_force - 1.));
        }
      else
        {
          ++n_free;
          if (strain > 0.)
            distance =
              std::max(distance,
                       std::abs((3. - now.distance) / (3. - exact_r) - 1.));
        }
    }
  std::cout << std::defaultfloat << std::setprecision(12);

  claims.near("rows compared on the way to the meeting", n_free, 12., 0.);
  claims.near("rows compared with the gap held", n_held, 7., 0.);
  claims.at_most("relative error of the distance covered", distance, 0.003);
  claims.at_most("relative error of the angle turned", angle, 0.01);
  claims.at_most("relative error of the spin", spin, 0.005);
  claims.at_most("error of the distance that is held", held, 1e-12);
  claims.at_most("relative error of the force that holds it", force, 0.01);

  // The pair is held at the end of the step in which it meets, up to the step
  // in which the line of centres is upright; there the force changes its sign.
  const auto first = std::find_if(computed.begin(),
                                  computed.end(),
                                  [](const Instant &i) { return i.held; });
  const auto last  = std::find_if(first,
                                 computed.end(),
                                 [](const Instant &i) { return !i.held; }) -
                    1;
  claims.near("the pair is held from the step in which it meets",
              first->strain - dt / 2.,
              meeting,
              dt / 2.);
  claims.holds("it is let go in the step after attraction sets in",
               last->force < 0. && last->degrees > 90. &&
                 (last - 1)->force >= 0. && (last - 1)->degrees < 90.2);
  claims.at_least("it then separates", computed.back().distance - 2.04, 1e-3);
}



/// Of the quarter domain, where a single sphere is meshed.
void
claim_second_order(Tests::Claims &claims)
{
  std::vector<Instant> ends;
  for (const double dt : {0.25, 0.125, 0.0625})
    ends.push_back(
      trajectory(Symmetry::quarter, Tests::resolution(32, 1), dt, 1.).back());
  const auto order = [&](double Instant::*const quantity) {
    return std::log2((ends[0].*quantity - ends[1].*quantity) /
                     (ends[1].*quantity - ends[2].*quantity));
  };
  claims.near("order of the distance in the time step",
              order(&Instant::distance),
              2.,
              0.3);
  claims.near("order of the angle in the time step",
              order(&Instant::degrees),
              2.,
              0.3);
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    claim_second_order(claims);
    claim_exact_trajectory(claims);
  });
}

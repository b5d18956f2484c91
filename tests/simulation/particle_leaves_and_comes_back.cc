// A disc in a viscoelastic fluid that leaves through the end of the period
// comes back on the other side: its motion does not notice. The fluid's does
// not either: the run is repeated with the disc half a period away from there.

#include <catena/simulation/simulation.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;



struct Instant
{
  double       x;
  Tensor<1, 2> velocity;
  double       spin;
  double       trace;
  bool         remeshed;
};



std::vector<Instant>
run_from(const double x)
{
  Scene<2> scene;
  scene.length    = 8.;
  scene.height    = 8.;
  scene.particles = {{Point<2>(x, 1.5)}};
  SimulationParameters parameters;
  parameters.fluid.giesekus.weissenberg_number = 1.;
  parameters.step_control.time_step            = 0.1;
  parameters.final_strain                      = 4.;
  parameters.mesh.elements_on_equator          = 32;
  parameters.mesh.elements_across_gap          = 1;
  parameters.mesh.maximal_size                 = 0.4;

  Simulation<2> simulation(scene, parameters, MPI_COMM_WORLD);
  simulation.initialize();
  std::vector<Instant> instants;
  while (simulation.strain() < parameters.final_strain - 1e-9)
    {
      const StepReport report = simulation.advance();
      const auto      &now    = simulation.current_state().now;
      double           trace  = 0.;
      for (unsigned int k = 0; k < 2; ++k)
        trace = std::max(trace, now.log_conformation[k].linfty_norm());
      instants.push_back({now.configuration.centres[0][0],
                          now.flow.motions[0].velocity,
                          now.flow.motions[0].angular_velocity[2],
                          trace,
                          report.remeshed});
    }
  return instants;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    // the disc moves by some -1.5 a gamma
    const auto leaving = run_from(-1.5), staying = run_from(2.5);

    unsigned int returns = 0;
    double       slip = 0., velocity = 0., spin = 0., stress = 0.;
    for (unsigned int i = 0; i < leaving.size(); ++i)
      {
        const Instant &a = leaving[i], &b = staying[i];
        if (i > 0 && a.x > leaving[i - 1].x + 4.)
          ++returns;
        slip     = std::max(slip, std::abs(std::remainder(a.x + 4. - b.x, 8.)));
        velocity = std::max(velocity, (a.velocity - b.velocity).norm());
        spin     = std::max(spin, std::abs(a.spin - b.spin));
        stress   = std::max(stress, std::abs(a.trace - b.trace));
        std::cout << i << ' ' << a.x << ' ' << b.x << ' ' << a.velocity << ' '
                  << b.velocity << ' ' << a.spin << ' ' << b.spin << ' '
                  << a.trace << ' ' << b.trace << ' ' << a.remeshed
                  << b.remeshed << std::endl;
      }
    claims.near("it comes back once", returns, 1., 0.);
    claims.at_most("place", slip, 2e-3);
    claims.at_most("velocity", velocity, 3e-3);
    claims.at_most("spin", spin, 3e-3);
    claims.at_most("largest stretch", stress, 0.1);
  });
}

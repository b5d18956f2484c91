// A run goes on from the checkpoint of the same run alone: what differs is
// refused by its name, but for what has no influence on the past.

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/run_identity.h>

#include <functional>

#include "../tests.h"

#include "../refusal.h"

using namespace Catena;

namespace
{
  using Change = std::function<void(SimulationParameters &)>;

  /// With what a run is refused that has @p change, after one that has not.
  std::string
  refusal(const SimulationParameters &parameters,
          const Change               &change,
          const double                distance = 2.)
  {
    LineOfParticlesParameters line(2);
    line.distance = 2.;
    const RunIdentity before(line.scene<3>(), parameters);

    SimulationParameters changed = parameters;
    change(changed);
    line.distance = distance;
    const RunIdentity after(line.scene<3>(), changed);
    return Tests::refusal([&]() { after.check_continues(before); });
  }

  bool
  names(const std::string &message, const std::string &name)
  {
    return message.find(name) != std::string::npos;
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    using Model          = FluidParameters::Model;
    const Change nothing = [](SimulationParameters &) {};
    for (const Model of_checkpoint :
         {Model::newtonian, Model::carreau, Model::giesekus})
      {
        SimulationParameters parameters;
        parameters.fluid.model = of_checkpoint;
        claims.holds("the same run goes on",
                     refusal(parameters, nothing).empty());
        for (const Model other :
             {Model::newtonian, Model::carreau, Model::giesekus})
          if (other != of_checkpoint)
            claims.holds("another fluid is refused",
                         names(refusal(parameters,
                                       [&](SimulationParameters &p) {
                                         p.fluid.model = other;
                                       }),
                               "'Fluid / Model'"));
      }

    const SimulationParameters parameters;
    claims.holds("another parameter of the fluid is refused",
                 names(refusal(parameters,
                               [](SimulationParameters &p) {
                                 p.fluid.giesekus.mobility_parameter = 0.3;
                               }),
                       "'Fluid / Mobility parameter' = 0.3"));
    claims.holds("another mesh is refused",
                 names(refusal(parameters,
                               [](SimulationParameters &p) {
                                 p.mesh.elements_on_equator = 65;
                               }),
                       "'Mesh / Elements on equator' = 65"));
    claims.holds("another scene is refused",
                 names(refusal(parameters, nothing, 2.5),
                       "first place of particle 0"));
    claims.holds("what has no influence on the past may change",
                 refusal(parameters, [](SimulationParameters &p) {
                   p.final_strain           = 70.;
                   p.step_control.tolerance = 1e-3;
                   p.flow_solver.tolerance  = 1e-8;
                   p.mesh.time_limit        = 60.;
                   p.output_directory       = "elsewhere";
                 }).empty());
  });
}

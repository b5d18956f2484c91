// The particles of a viscoelastic scene are held for one relaxation time; the
// forces that held them then fall linearly over the release strain, at the end
// of which a time step ends.

#include <catena/simulation/shear_protocol.h>

#include "../tests.h"

using namespace Catena;
using namespace Catena::Tests;



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    SimulationParameters parameters;
    parameters.fluid.giesekus.weissenberg_number = 3.;
    parameters.release_strain                    = 0.4;
    const ShearProtocol protocol(parameters, true, true);

    claims.near("start", protocol.start(), -3., 0.);
    claims.holds("held before strain 0", protocol.holds(-0.1));
    claims.holds("free from there on", !protocol.holds(0.));
    claims.near("the force at strain 0", protocol.holding_share(0.), 1., 0.);
    claims.near("at half of the release",
                protocol.holding_share(0.2),
                0.5,
                1e-12);
    claims.near("at its end", protocol.holding_share(0.4), 0., 0.);
    claims.near("after it", protocol.holding_share(0.5), 0., 0.);
    claims.near("a step ends at strain 0", protocol.next_instant(-1.), 0., 0.);
    claims.near("and at the end of the release",
                protocol.next_instant(0.),
                0.4,
                0.);

    const ShearProtocol free(parameters, false, true);
    claims.near("without a start-up, the start", free.start(), 0., 0.);
    claims.near("the first instant, the end of the run",
                free.next_instant(0.),
                parameters.final_strain,
                0.);
  });
}

/**
 * The rotation rate of a lone sphere in sheared fluid, Newtonian, Carreau or
 * viscoelastic, against the shear rate.
 *
 * Sample runs:
 *   one_particle parameter_files/one_particle/quick.prm
 *   one_particle parameter_files/one_particle/carreau.prm
 */

#include <catena/scene/one_particle.h>
#include <catena/simulation/sweep_program.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  return run_sweep_program(
    argc,
    argv,
    "one_particle",
    "The rotation rate of a lone sphere in sheared Newtonian, Carreau or "
    "viscoelastic fluid.",
    OneParticleParameters(),
    rotation_rate<3>());
}

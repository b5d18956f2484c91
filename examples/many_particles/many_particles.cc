/**
 * Any number of particles, given or at random places, in sheared Newtonian,
 * Carreau or viscoelastic fluid.
 *
 * Sample runs:
 *   many_particles parameter_files/many_particles/quick.prm
 *   many_particles parameter_files/many_particles/ten.prm
 */

#include <catena/scene/many_particles.h>
#include <catena/simulation/scene_program.h>

int
main(int argc, char **argv)
{
  return Catena::run_scene_program(
    argc,
    argv,
    "many_particles",
    "Any number of particles in sheared Newtonian, Carreau or viscoelastic "
    "fluid.",
    Catena::ManyParticlesParameters());
}

/**
 * Two particles in sheared Newtonian, Carreau or viscoelastic fluid: do they
 * align or pass each other?
 *
 * Sample runs:
 *   two_particles parameter_files/two_particles/quick.prm
 *   two_particles parameter_files/two_particles/aligning.prm
 *   mpirun -np 2 two_particles parameter_files/two_particles/passing.prm
 */

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/scene_program.h>

int
main(int argc, char **argv)
{
  return Catena::run_scene_program(
    argc,
    argv,
    "two_particles",
    "Two particles in sheared Newtonian, Carreau or viscoelastic fluid.",
    Catena::LineOfParticlesParameters(2));
}

/**
 * Three particles in sheared Newtonian, Carreau or viscoelastic fluid: do they
 * align into a string or pass each other?
 *
 * Sample runs:
 *   three_particles parameter_files/three_particles/quick.prm
 *   three_particles parameter_files/three_particles/aligning.prm
 *   mpirun -np 2 three_particles parameter_files/three_particles/passing.prm
 */

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/scene_program.h>

int
main(int argc, char **argv)
{
  return Catena::run_scene_program(
    argc,
    argv,
    "three_particles",
    "Three particles in a line in sheared Newtonian, Carreau or viscoelastic "
    "fluid.",
    Catena::LineOfParticlesParameters(3));
}

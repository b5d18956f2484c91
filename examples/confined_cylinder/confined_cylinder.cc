/**
 * The drag on a cylinder in a channel, past which a Newtonian, Carreau or
 * viscoelastic fluid is driven by pressure, against the flow rate.
 *
 * Sample runs:
 *   confined_cylinder parameter_files/confined_cylinder/quick.prm
 *   confined_cylinder parameter_files/verification/confined_cylinder.prm
 */

#include <catena/scene/confined_cylinder.h>
#include <catena/simulation/sweep_program.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  return run_sweep_program(
    argc,
    argv,
    "confined_cylinder",
    "The drag on a cylinder in a channel of Newtonian, Carreau or "
    "viscoelastic fluid.",
    ConfinedCylinderParameters(),
    drag_coefficient<2>());
}

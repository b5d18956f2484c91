/**
 * The material functions of a Newtonian, Carreau, Giesekus or Oldroyd-B fluid
 * in shear and in uniaxial extension, steady and starting up.
 *
 * Sample runs:
 *   rheometer parameter_files/rheometer/quick.prm
 *   rheometer parameter_files/rheometer/carreau.prm
 *   rheometer parameter_files/rheometer/oldroyd_b.prm
 */

#include <catena/base/program_options.h>
#include <catena/output/rheometer_tables.h>

int
main(int argc, char **argv)
{
  using namespace Catena;

  RheometerParameters rheometer;

  Program program;
  program.name = "rheometer";
  program.description =
    "Viscosity and normal stresses of a fluid in shear and extension.";
  program.declare = [&](dealii::ParameterHandler &prm) {
    rheometer.declare(prm);
  };
  program.check = [&]() { rheometer.check(); };
  program.run   = [&](const ProgramOptions &options) {
    write_rheometer_tables(rheometer,
                           options.results_directory(
                             rheometer.output_directory),
                           options.overwrite,
                           MPI_COMM_WORLD);
  };
  return run_program(argc, argv, program);
}

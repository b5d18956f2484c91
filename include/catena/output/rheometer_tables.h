#ifndef catena_output_rheometer_tables_h
#define catena_output_rheometer_tables_h

#include <catena/rheology/rheometer_parameters.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace Catena
{
  /**
   * Write the curves that @p parameters asks for to @p directory, as tables of
   * comma-separated values with 16 significant digits. Each has the columns
   * `rate [gamma]` and `Wi` = lambda rate, and
   *
   * - `steady_shear.csv`: `viscosity [eta0]`, `N1 [eta0 gamma]`,
   *   `N2 [eta0 gamma]`, `S`, see ShearFunctions;
   * - `start_up_shear.csv`: `time [1/gamma]`, `strain` = rate time, then the
   *   same;
   * - `steady_extension.csv`: `extensional_viscosity [eta0]`, `nan` where
   *   there is no steady state;
   * - `start_up_extension.csv`: `time [1/gamma]`, `strain`,
   *   `extensional_viscosity [eta0]`.
   *
   * A line for each table goes to the standard output. Collective.
   *
   * @throws InputError if the parameters or the directory cannot be used; see
   *   prepare_output_directory() for @p overwrite.
   * @throws Error if a table cannot be written.
   */
  void
  write_rheometer_tables(const RheometerParameters &parameters,
                         const std::string         &directory,
                         const bool                 overwrite,
                         const MPI_Comm             communicator);
} // namespace Catena

#endif

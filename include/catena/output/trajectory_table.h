#ifndef catena_output_trajectory_table_h
#define catena_output_trajectory_table_h

#include <catena/base/archive.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace Catena
{
  /**
   * A table of comma-separated values that grows by one row a time step.
   *
   * The columns are declared once, with their units; the first line of the
   * file names them:
   * @code
   * strain,dt,theta [deg],distance 0-1 [a]
   * @endcode
   * Each row is handed to the operating system as soon as it is complete, so
   * that a run that is killed loses no finished row. A later run can go on
   * after any row. Values have ten significant digits unless told otherwise.
   *
   * Process 0 of the communicator writes; the others may declare columns and
   * add values as well, and take part in opening the file and in write_row().
   */
  class TrajectoryTable
  {
  public:
    /// The end of a row.
    struct Position
    {
      std::uint64_t bytes = 0;
      unsigned int  rows  = 0;

      /// Save or load it.
      void
      archive(Archive &archive)
      {
        archive(bytes, rows);
      }
    };

    /**
     * Open @p path, replacing what it held, for values with @p n_digits
     * significant digits. Collective.
     *
     * @throws Error if the file cannot be opened.
     */
    TrajectoryTable(const std::string &path,
                    const MPI_Comm     communicator,
                    const unsigned int n_digits = 10);

    /**
     * Go on with the table @p path after @p position; rows behind it are
     * removed. Collective.
     *
     * @throws Error if there is no row that ends at this position, or the file
     * cannot be opened.
     */
    TrajectoryTable(const std::string &path,
                    const MPI_Comm     communicator,
                    const Position    &position,
                    const unsigned int n_digits = 10);

    /**
     * Add a column at the right. All columns are declared before the first
     * row is written; a name may be used once and cannot contain a comma or a
     * line break. Quantities without dimension have no @p unit.
     *
     * @throws dealii::ExcMessage if the name or the moment is not like that.
     */
    void
    declare(const std::string &name, const std::string &unit = "");

    /**
     * Set the value of column @p name in the present row.
     *
     * @throws dealii::ExcMessage if there is no such column or it has a value
     *   already.
     */
    void
    add(const std::string &name, const double value);

    /**
     * Write the present row and begin the next. Collective.
     *
     * @throws Error on all processes if the row cannot be written (disk full).
     * @throws dealii::ExcMessage if a column has no value.
     */
    void
    write_row();

    /**
     * Bring all rows to the disk, and tell where the last one ends.
     * Collective.
     *
     * @throws Error if that is not possible.
     */
    Position
    sync();

    /**
     * Number of rows written.
     */
    unsigned int
    n_rows() const;

  private:
    struct Column
    {
      std::string heading;
      double      value  = 0.;
      bool        is_set = false;
    };

    const std::string                   path;
    const MPI_Comm                      communicator;
    const unsigned int                  n_digits;
    std::ofstream                       file;
    std::vector<Column>                 columns;
    std::map<std::string, unsigned int> index_of;
    unsigned int                        rows_written = 0;
    bool                                row_begun    = false;

    /**
     * Throw on all processes if process 0 found the file in a bad state.
     */
    void
    check_file(const std::string &what_failed) const;
  };
} // namespace Catena

#endif

#ifndef catena_output_run_report_h
#define catena_output_run_report_h

#include <catena/base/archive.h>

#include <deal.II/base/mpi.h>

#include <istream>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Name of the BLAS library among the libraries that @p maps lists, which has
   * the format of /proc/self/maps. The reference implementation, which a fresh
   * Debian installs and which makes direct solvers ten times slower, is said
   * to be one.
   */
  std::string
  blas_library(std::istream &maps);

  /**
   * Name of the BLAS library this program uses.
   */
  std::string
  blas_library();

  /**
   * What a run has cost: time by part, counters, memory, and notes such as the
   * number of unknowns.
   *
   * @code
   * RunReport report(communicator);
   * report.note("elements", triangulation.n_active_cells());
   * {
   *   const auto step = report.step();
   *   {
   *     const auto timer = report.time("flow: solve");
   *     ...
   *   }
   *   report.count("linear iterations", n);
   * }
   * report.print(std::cout);
   * @endcode
   *
   * Parts are not nested: their times, together with what is left over, add up
   * to the time since the report was made. Times are those of process 0,
   * memory is summed over the processes.
   */
  class RunReport
  {
  public:
    /**
     * Adds the time of its life to a part of the report, which has to live
     * longer.
     */
    class Timer
    {
    public:
      Timer(double &seconds);
      ~Timer();

      Timer(const Timer &) = delete;
      Timer &
      operator=(const Timer &) = delete;

    private:
      double      &seconds;
      const double begin;
    };

    explicit RunReport(const MPI_Comm communicator);

    /**
     * Count the time until the returned object dies as time of @p part.
     */
    [[nodiscard]] Timer
    time(const std::string &part);

    /**
     * Count the time until the returned object dies as one time step. This
     * time is not a part: it gives the mean seconds a step.
     */
    [[nodiscard]] Timer
    step();

    /**
     * Number of time steps begun.
     */
    unsigned long
    n_steps() const;

    /**
     * Seconds spent in @p part so far, without a timer that is running.
     */
    double
    seconds(const std::string &part) const;

    /**
     * Add @p n to the counter @p name.
     */
    void
    count(const std::string &name, const unsigned long n = 1);

    /**
     * State of the counter @p name, zero if it was never used.
     */
    unsigned long
    counter(const std::string &name) const;

    /**
     * Note a fact; a second note of the same @p name replaces the first.
     */
    template <typename T>
    void
    note(const std::string &name, const T &value);

    /**
     * Save or load steps and counters, but no times of parts: those are of one
     * program.
     */
    void
    archive(Archive &archive);

    /**
     * Print all of it as one table. Collective; process 0 prints.
     */
    void
    print(std::ostream &out) const;

    /**
     * Write the table into the file run_report.txt of @p directory.
     * Collective.
     *
     * @throws Error if it cannot be written.
     */
    void
    write(const std::string &directory) const;

  private:
    /// Entries in the order in which they were first mentioned.
    template <typename T>
    using List = std::vector<std::pair<std::string, T>>;

    struct Part
    {
      double        seconds = 0.;
      unsigned long calls   = 0;
    };

    const MPI_Comm communicator;
    const double   begin;

    /// Timers hold references to their parts, which therefore do not move.
    List<std::unique_ptr<Part>> parts;
    Part                        steps;
    List<unsigned long>         counters;
    List<std::string>           notes;

    std::string
    table() const;

    void
    print_times(std::ostream &out, const double total) const;

    void
    set_note(const std::string &name, const std::string &value);
  };



  template <typename T>
  void
  RunReport::note(const std::string &name, const T &value)
  {
    std::ostringstream text;
    text << value;
    set_note(name, text.str());
  }
} // namespace Catena

#endif

#ifndef catena_output_progress_h
#define catena_output_progress_h

#include <deal.II/base/mpi.h>

#include <deque>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

namespace Catena
{
  /**
   * A time in words that fit a line: "4.2 s", "3 min 20 s", "2 h 05 min".
   */
  std::string
  duration_in_words(const double seconds);

  /**
   * One line that tells how far a run is:
   * @code
   * strain 12.40 of 50, theta 43.2 deg, dt 0.08, 11 its, 0.42 s/step, 3 min 20
   * s left
   * @endcode
   * On a terminal the line is rewritten in place. Anywhere else (a log file) a
   * new line appears only when another 5 % of the run or 30 seconds have
   * passed. The time left follows from the progress of the last steps.
   * Process 0 prints, the others are silent.
   */
  class Progress
  {
  public:
    /**
     * What a step reports.
     */
    struct Status
    {
      /// Strain gamma t reached.
      double strain = 0.;

      /// Orientation of the line of particles in degrees, if there is one.
      std::optional<double> theta;

      /// Time step, in 1/gamma.
      double dt = 0.;

      /// Linear iterations of the step.
      unsigned int iterations = 0;
    };

    /**
     * A function like wall_clock().
     */
    using Clock = std::function<double()>;

    /**
     * Report a run from strain @p begin to strain @p end on standard output.
     */
    Progress(const double begin, const double end, const MPI_Comm communicator);

    /**
     * The same for any stream, with the choice of a @p terminal or a log, and
     * any clock.
     */
    Progress(const double   begin,
             const double   end,
             const MPI_Comm communicator,
             std::ostream  &out,
             const bool     terminal,
             const Clock   &clock);

    /**
     * A line that was begun is ended.
     */
    ~Progress();

    Progress(const Progress &) = delete;
    Progress &
    operator=(const Progress &) = delete;

    /**
     * Tell that a step is done.
     */
    void
    update(const Status &status);

    /**
     * Print a line of its own, such as "remeshed at strain 3.2".
     */
    void
    message(const std::string &text);

    /**
     * Print the last status, if it has not been printed, and end the line.
     */
    void
    finish();

    /**
     * Seconds left, estimated from the recent steps; negative if unknown.
     */
    double
    seconds_left() const;

  private:
    /// A strain and the second at which it was reached.
    struct Mark
    {
      double strain;
      double second;
    };

    const double  begin;
    const double  end;
    const bool    is_writer;
    std::ostream &out;
    const bool    terminal;
    const Clock   clock;

    /// The recent steps, oldest first.
    std::deque<Mark> recent;

    /// What was last printed in a log.
    Mark printed;

    /// The line that is to be shown now.
    std::string line;

    /// The line shown on the terminal, or in the log, is not up to date.
    bool pending = false;

    /// There is a line on the terminal that was not ended.
    bool open = false;

    std::string
    text_of(const Status &status) const;

    void
    rewrite_line();

    void
    print_line();
  };
} // namespace Catena

#endif

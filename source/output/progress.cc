#include <catena/base/wall_clock.h>
#include <catena/output/progress.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Steps from which the speed is estimated.
    constexpr unsigned int n_recent_steps = 20;

    /// A log gets a line each time this part of the run is done ...
    constexpr double log_fraction = 0.05;

    /// ... or these seconds have passed.
    constexpr double log_seconds = 30.;



    template <typename... Values>
    std::string
    format(const char *pattern, const Values... values)
    {
      char text[200];
      std::snprintf(text, sizeof(text), pattern, values...);
      return text;
    }



    /**
     * Number of characters that fit in a line of the terminal.
     */
    std::size_t
    terminal_width()
    {
      winsize size;
      if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
        return size.ws_col - 1;
      return 79;
    }
  } // namespace



  std::string
  duration_in_words(const double seconds)
  {
    if (seconds < 9.95)
      return format("%.1f s", seconds);

    const long whole = std::lround(seconds);
    if (whole < 60)
      return format("%ld s", whole);
    if (whole < 3600)
      return format("%ld min %02ld s", whole / 60, whole % 60);
    return format("%ld h %02ld min", whole / 3600, whole % 3600 / 60);
  }



  Progress::Progress(const double   begin,
                     const double   end,
                     const MPI_Comm communicator)
    : Progress(begin,
               end,
               communicator,
               std::cout,
               isatty(STDOUT_FILENO) == 1,
               wall_clock)
  {}



  Progress::Progress(const double   begin,
                     const double   end,
                     const MPI_Comm communicator,
                     std::ostream  &out,
                     const bool     terminal,
                     const Clock   &clock)
    : begin(begin)
    , end(end)
    , is_writer(Utilities::MPI::this_mpi_process(communicator) == 0)
    , out(out)
    , terminal(terminal)
    , clock(clock)
    , recent({{begin, clock()}})
    , printed(recent.front())
  {}



  Progress::~Progress()
  {
    if (open)
      out << std::endl;
  }



  void
  Progress::update(const Status &status)
  {
    recent.push_back({status.strain, clock()});
    if (recent.size() > n_recent_steps + 1)
      recent.pop_front();

    line    = text_of(status);
    pending = true;
    if (!is_writer)
      return;

    if (terminal)
      rewrite_line();
    else
      {
        const Mark  &now = recent.back();
        const double done =
          (now.strain - printed.strain) / std::abs(end - begin);
        if (std::abs(done) >= log_fraction * (1. - 1e-10) ||
            now.second - printed.second >= log_seconds)
          print_line();
      }
  }



  void
  Progress::message(const std::string &text)
  {
    if (!is_writer)
      return;
    if (open)
      out << "\r\033[K";
    out << text << std::endl;
    if (open)
      rewrite_line();
  }



  void
  Progress::finish()
  {
    if (!is_writer)
      return;
    if (open)
      out << std::endl;
    else if (pending)
      print_line();
    open    = false;
    pending = false;
  }



  double
  Progress::seconds_left() const
  {
    const double gained = recent.back().strain - recent.front().strain;
    const double spent  = recent.back().second - recent.front().second;
    const double rate   = gained / spent;
    const double left   = (end - recent.back().strain) / rate;
    return gained != 0. && spent > 0. && left >= 0. ? left : -1.;
  }



  std::string
  Progress::text_of(const Status &status) const
  {
    const double per_step =
      (recent.back().second - recent.front().second) / (recent.size() - 1);

    std::string text = format("strain %.2f of %g", status.strain, end);
    if (status.theta)
      text += format(", theta %.1f deg", *status.theta);
    text += format(", dt %.3g, %u its, %.2g s/step",
                   status.dt,
                   status.iterations,
                   per_step);
    if (seconds_left() >= 0.)
      text += ", " + duration_in_words(seconds_left()) + " left";
    return text;
  }



  void
  Progress::rewrite_line()
  {
    out << '\r' << line.substr(0, terminal_width()) << "\033[K" << std::flush;
    open    = true;
    pending = false;
  }



  void
  Progress::print_line()
  {
    out << line << std::endl;
    printed = recent.back();
    pending = false;
  }
} // namespace Catena

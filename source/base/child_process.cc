#include <catena/base/child_process.h>
#include <catena/base/error_text.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>

namespace Catena
{
  namespace
  {
    constexpr char succeeded = 's', failed = 'f';



    /// The answer of a child: whether it succeeded, and with what.
    std::string
    answer(const std::function<std::string()> &work)
    {
      try
        {
          return succeeded + work();
        }
      catch (const std::exception &error)
        {
          return failed + error_text(error);
        }
      catch (const std::string &error)
        {
          return failed + squeeze(error);
        }
      catch (...)
        {
          return std::string(1, failed) + "unknown exception";
        }
    }



    std::string
    result(const std::string &answer)
    {
      if (answer[0] != succeeded)
        throw ChildError(answer.substr(1));
      return answer.substr(1);
    }



    [[noreturn]] void
    be_child(const std::function<std::string()> &work, const int pipe)
    {
      // it ends with its parent, and dies of what kills programs
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGTERM, SIGUSR1})
        std::signal(signal, SIG_DFL);
      const std::string bytes = answer(work);
      for (std::size_t done = 0; done < bytes.size();)
        {
          const ssize_t n =
            write(pipe, bytes.data() + done, bytes.size() - done);
          if (n < 0 && errno != EINTR)
            _exit(1);
          done += n > 0 ? n : 0;
        }
      _exit(0);
    }



    /// All that comes out of @p pipe until it is closed. @return in time?
    bool
    read_all(const int pipe, const double seconds, std::string &bytes)
    {
      using Clock = std::chrono::steady_clock;
      const auto deadline =
        Clock::now() + std::chrono::duration<double>(seconds);
      std::array<char, 65536> buffer;
      while (true)
        {
          const double left =
            std::chrono::duration<double>(deadline - Clock::now()).count();
          if (left <= 0.)
            return false;
          pollfd ready{pipe, POLLIN, 0};
          // in pieces: a limit of days does not fit
          if (poll(&ready,
                   1,
                   static_cast<int>(std::min(left, 1e3) * 1e3) + 1) <= 0)
            continue;
          const ssize_t n = read(pipe, buffer.data(), buffer.size());
          if (n == 0)
            return true;
          if (n > 0)
            bytes.append(buffer.data(), n);
          else if (errno != EINTR)
            return true;
        }
    }
  } // namespace



  std::string
  run_in_child(const std::function<std::string()> &work, const double seconds)
  {
    int ends[2];
    if (pipe(ends) != 0)
      return result(answer(work));
    const pid_t child = fork();
    if (child == 0)
      {
        close(ends[0]);
        be_child(work, ends[1]);
      }
    close(ends[1]);
    if (child < 0)
      {
        close(ends[0]);
        return result(answer(work));
      }

    std::string bytes;
    const bool  in_time = read_all(ends[0], seconds, bytes);
    close(ends[0]);
    if (!in_time)
      kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      {}

    std::ostringstream text;
    if (!in_time)
      text << "it took longer than " << seconds << " s";
    else if (WIFSIGNALED(status))
      text << "it ended by " << strsignal(WTERMSIG(status));
    else if (bytes.empty() || WEXITSTATUS(status) != 0)
      text << "it ended without a result";
    else
      return result(bytes);
    throw ChildError(text.str());
  }
} // namespace Catena

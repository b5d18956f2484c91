#ifndef catena_base_child_process_h
#define catena_base_child_process_h

#include <catena/base/exceptions.h>

#include <functional>
#include <string>

namespace Catena
{
  /**
   * What was done in a child process failed, crashed or took too long.
   */
  class ChildError : public Error
  {
  public:
    using Error::Error;
  };

  /**
   * Call @p work in a child process, a copy of this one, for at most
   * @p seconds: what it does cannot harm this process, and ends in time. It
   * must not communicate with other processes. Where no process can be made
   * it is called here.
   *
   * @return what @p work returns
   * @throws ChildError with the message of what @p work has thrown, or how
   * else it ended
   */
  std::string
  run_in_child(const std::function<std::string()> &work, const double seconds);
} // namespace Catena

#endif

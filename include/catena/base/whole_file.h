#ifndef catena_base_whole_file_h
#define catena_base_whole_file_h

#include <functional>
#include <ostream>
#include <string>

namespace Catena
{
  /**
   * Files that are there as a whole or not at all, also when the computer
   * stops at any instant: they are written under another name, brought to the
   * disk and then renamed. What was there before stays until then.
   *
   * These functions return 0, or the number of the error as errno has it. Then
   * nothing is left of the new file; or, where the disk fails when the new name
   * is brought to it, the file is the new one, which may not last.
   */
  namespace WholeFile
  {
    /// The name under which @p path is written.
    std::string
    draft(const std::string &path);

    /// Make the draft of @p path, which is complete, the file.
    int
    publish(const std::string &path);

    /// Write @p path by @p content, which gets the stream.
    int
    write(const std::string                         &path,
          const std::function<void(std::ostream &)> &content);
  } // namespace WholeFile
} // namespace Catena

#endif

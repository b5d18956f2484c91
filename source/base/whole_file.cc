#include <catena/base/whole_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace Catena
{
  namespace
  {
    /// Bring a file or a directory to the disk.
    bool
    sync(const std::string &path, const int flags)
    {
      const int file = open(path.c_str(), flags);
      if (file < 0)
        return false;
      // some file systems cannot do this with a directory, and need not
      const bool good =
        fsync(file) == 0 || ((flags & O_DIRECTORY) != 0 && errno == EINVAL);
      const int error = errno;
      close(file);
      errno = error;
      return good;
    }



    /// The present error, after the draft of @p path has been removed.
    int
    give_up(const std::string &path)
    {
      const int error = errno;
      std::remove(WholeFile::draft(path).c_str());
      return error != 0 ? error : EIO;
    }
  } // namespace



  std::string
  WholeFile::draft(const std::string &path)
  {
    return path + ".part";
  }



  int
  WholeFile::publish(const std::string &path)
  {
    const auto folder = std::filesystem::absolute(path).parent_path().string();
    const bool good   = sync(draft(path), O_WRONLY) &&
                      std::rename(draft(path).c_str(), path.c_str()) == 0 &&
                      // a new name lasts when its folder is on the disk as well
                      sync(folder, O_RDONLY | O_DIRECTORY);
    return good ? 0 : give_up(path);
  }



  int
  WholeFile::write(const std::string                         &path,
                   const std::function<void(std::ostream &)> &content)
  {
    errno = 0;
    std::ofstream file(draft(path), std::ios::binary);
    try
      {
        if (file)
          content(file);
      }
    catch (...)
      {
        give_up(path);
        throw;
      }
    file.close();
    return file ? publish(path) : give_up(path);
  }
} // namespace Catena

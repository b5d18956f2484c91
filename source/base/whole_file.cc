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
    /// An open file or folder.
    class Opened
    {
    public:
      Opened(const std::string &path, const int flags)
        : file(open(path.c_str(), flags))
      {}

      ~Opened()
      {
        const int error = errno;
        if (file >= 0)
          close(file);
        errno = error;
      }

      Opened(const Opened &) = delete;

      Opened &
      operator=(const Opened &) = delete;

      bool
      is_open() const
      {
        return file >= 0;
      }

      /// Bring it to the disk.
      bool
      sync() const
      {
        // some file systems cannot do this with a folder, and need not
        return is_open() && (fsync(file) == 0 || errno == EINVAL);
      }

    private:
      const int file;
    };



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
    const Opened folder(std::filesystem::absolute(path).parent_path().string(),
                        O_RDONLY | O_DIRECTORY);
    const bool   good = folder.is_open() &&
                      Opened(draft(path), O_WRONLY).sync() &&
                      std::rename(draft(path).c_str(), path.c_str()) == 0 &&
                      // a new name lasts when its folder is on the disk as well
                      folder.sync();
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

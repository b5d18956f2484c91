#include <catena/base/checked_file.h>
#include <catena/base/exceptions.h>

#include <boost/crc.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace Catena
{
  namespace
  {
    constexpr char        name[]      = "Catena state";
    constexpr std::size_t name_length = 16, header_length = 36;

    std::uint32_t
    checksum(const char *data, const std::size_t size)
    {
      boost::crc_32_type crc;
      crc.process_bytes(data, size);
      return crc.checksum();
    }



    template <typename T>
    void
    append(std::string &bytes, const T value)
    {
      bytes.append(reinterpret_cast<const char *>(&value), sizeof(T));
    }



    template <typename T>
    T
    take(const std::string &bytes, const std::size_t position)
    {
      T value;
      std::memcpy(&value, bytes.data() + position, sizeof(T));
      return value;
    }



    std::string
    header(const unsigned int version, const std::string &content)
    {
      std::string bytes = name;
      bytes.resize(name_length, '\0');
      append<std::uint32_t>(bytes, version);
      append<std::uint32_t>(bytes, checksum(content.data(), content.size()));
      append<std::uint64_t>(bytes, content.size());
      append<std::uint32_t>(bytes, checksum(bytes.data(), bytes.size()));
      return bytes;
    }



    [[noreturn]] void
    fail(const std::string &path, const std::string &reason)
    {
      throw CheckpointError("Checkpoint '" + path + "' " + reason);
    }



    bool
    write_all(const int file, const std::string &bytes)
    {
      for (std::size_t done = 0; done < bytes.size();)
        {
          const ssize_t n =
            ::write(file, bytes.data() + done, bytes.size() - done);
          if (n < 0 && errno != EINTR)
            return false;
          done += n > 0 ? n : 0;
        }
      return true;
    }



    /// A new name lasts when the directory is on the disk as well.
    bool
    sync_directory(const std::string &path)
    {
      const std::string folder =
        std::filesystem::absolute(path).parent_path().string();
      const int directory = open(folder.c_str(), O_RDONLY | O_DIRECTORY);
      if (directory < 0)
        return false;
      // some file systems cannot do this, and need not
      const bool good = fsync(directory) == 0 || errno == EINVAL;
      close(directory);
      return good;
    }
  } // namespace



  void
  CheckedFile::write(const std::string &path,
                     const unsigned int version,
                     const std::string &content)
  {
    const std::string draft = path + ".part";
    const int file = open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    bool      good = file >= 0 && write_all(file, header(version, content)) &&
                write_all(file, content) && fsync(file) == 0;
    int error = errno;
    if (file >= 0 && close(file) != 0 && good)
      {
        good  = false;
        error = errno;
      }
    if (good)
      {
        good =
          std::rename(draft.c_str(), path.c_str()) == 0 && sync_directory(path);
        error = errno;
      }
    if (!good)
      {
        std::remove(draft.c_str());
        fail(path,
             std::string("cannot be written (") + std::strerror(error) +
               "): make room on the disk or check the permissions");
      }
  }



  std::string
  CheckedFile::read(const std::string &path, const unsigned int version)
  {
    std::error_code error;
    std::ifstream   file(path, std::ios::binary);
    if (!file || !std::filesystem::is_regular_file(path, error))
      fail(path, "cannot be read");
    std::string bytes(header_length, '\0');
    file.read(bytes.data(), header_length);
    if (file.gcount() != header_length)
      fail(path, "is damaged: it is too short");
    if (std::strncmp(bytes.data(), name, name_length) != 0)
      fail(path, "is none: it does not begin like one");
    if (take<std::uint32_t>(bytes, header_length - 4) !=
        checksum(bytes.data(), header_length - 4))
      fail(path, "is damaged: the checksum of its header is wrong");
    const auto found = take<std::uint32_t>(bytes, name_length);
    if (found != version)
      fail(path,
           "has version " + std::to_string(found) + ", this program reads " +
             std::to_string(version) +
             ": go on with the program that wrote it, or start anew");
    const auto crc  = take<std::uint32_t>(bytes, name_length + 4);
    const auto size = take<std::uint64_t>(bytes, name_length + 8);
    if (std::filesystem::file_size(path, error) != header_length + size ||
        error)
      fail(path, "is damaged: its length is not what it should be");

    std::string content(size, '\0');
    file.read(content.data(), size);
    if (static_cast<std::uint64_t>(file.gcount()) != size ||
        checksum(content.data(), size) != crc)
      fail(path, "is damaged: its checksum is wrong");
    return content;
  }
} // namespace Catena

#include <catena/base/checked_file.h>
#include <catena/base/exceptions.h>
#include <catena/base/whole_file.h>

#include <boost/crc.hpp>

#include <cstdint>
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



    std::uint32_t
    checksum(const std::vector<std::string> &pieces)
    {
      boost::crc_32_type crc;
      for (const std::string &piece : pieces)
        crc.process_bytes(piece.data(), piece.size());
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
    header(const unsigned int version, const std::vector<std::string> &pieces)
    {
      std::uint64_t size = 0;
      for (const std::string &piece : pieces)
        size += piece.size();
      std::string bytes = name;
      bytes.resize(name_length, '\0');
      append<std::uint32_t>(bytes, version);
      append<std::uint32_t>(bytes, checksum(pieces));
      append<std::uint64_t>(bytes, size);
      append<std::uint32_t>(bytes, checksum(bytes.data(), bytes.size()));
      return bytes;
    }



    [[noreturn]] void
    fail(const std::string &path, const std::string &reason)
    {
      throw CheckpointError("Checkpoint '" + path + "' " + reason);
    }
  } // namespace



  void
  CheckedFile::write(const std::string              &path,
                     const unsigned int              version,
                     const std::vector<std::string> &pieces)
  {
    const int error = WholeFile::write(path, [&](std::ostream &file) {
      file << header(version, pieces);
      for (const std::string &piece : pieces)
        file << piece;
    });
    if (error != 0)
      fail(path,
           std::string("cannot be written (") + std::strerror(error) +
             "): make room on the disk or check the permissions");
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

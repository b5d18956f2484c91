#include <catena/base/archive.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace Catena
{
  namespace
  {
    constexpr std::size_t size_of_piece = 1 << 20;
  } // namespace



  std::string
  Archive::bytes() const
  {
    std::size_t size = 0;
    for (const std::string &piece : saved)
      size += piece.size();
    std::string result;
    result.reserve(size);
    for (const std::string &piece : saved)
      result += piece;
    return result;
  }



  void
  Archive::save(const char *data, std::size_t size)
  {
    while (size > 0)
      {
        if (saved.empty() || saved.back().size() == size_of_piece)
          {
            saved.emplace_back();
            saved.back().reserve(size_of_piece);
          }
        std::string      &piece = saved.back();
        const std::size_t n     = std::min(size, size_of_piece - piece.size());
        piece.append(data, n);
        data += n;
        size -= n;
      }
  }



  void
  Archive::raw(void *data, const std::size_t size)
  {
    if (size == 0)
      return;
    if (!loading)
      {
        save(static_cast<const char *>(data), size);
        return;
      }
    if (size > content.size() - position)
      throw CheckpointError("it ends too early");
    std::memcpy(data, content.data() + position, size);
    position += size;
  }



  std::size_t
  Archive::length(const std::size_t present, const std::size_t smallest_entry)
  {
    std::uint64_t n = present;
    raw(&n, sizeof(n));
    if (loading && n > (content.size() - position) / smallest_entry)
      throw CheckpointError("it ends too early");
    return n;
  }



  void
  Archive::value(bool &x)
  {
    std::uint8_t byte = x ? 1 : 0;
    raw(&byte, 1);
    if (byte > 1)
      throw CheckpointError("it has a truth value of " + std::to_string(byte));
    x = byte == 1;
  }



  void
  Archive::value(std::string &x)
  {
    x.resize(length(x.size(), 1));
    raw(x.data(), x.size());
  }



  void
  Archive::finish() const
  {
    if (loading && position != content.size())
      throw CheckpointError("it has more than is known of");
  }
} // namespace Catena

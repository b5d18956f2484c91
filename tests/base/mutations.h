#ifndef catena_tests_base_mutations_h
#define catena_tests_base_mutations_h

#include <random>
#include <string>

namespace Catena
{
  namespace Tests
  {
    /**
     * Random damage to bytes, the same for the same seed with every standard
     * library.
     */
    class Mutations
    {
    public:
      explicit Mutations(const unsigned int seed)
        : generator(seed)
      {}

      /// A number in [0, n).
      std::size_t
      below(const std::size_t n)
      {
        return generator() % n;
      }

      /// @p bytes with one damage: a bit flipped, a byte or a piece replaced,
      /// removed, repeated, or the end cut off. Never the same.
      std::string
      damaged(const std::string &bytes)
      {
        std::string result = bytes;
        while (result == bytes)
          {
            const std::size_t at     = below(bytes.size());
            const std::size_t length = 1 + below(64);
            switch (below(6))
              {
                case 0:
                  result[at] ^= static_cast<char>(1 << below(8));
                  break;
                case 1:
                  result[at] = static_cast<char>(below(256));
                  break;
                case 2:
                  for (std::size_t i = at; i < at + length && i < bytes.size();
                       ++i)
                    result[i] = static_cast<char>(below(256));
                  break;
                case 3:
                  result.erase(at, length);
                  break;
                case 4:
                  result.insert(at, bytes.substr(below(bytes.size()), length));
                  break;
                default:
                  result.resize(at);
              }
          }
        return result;
      }

    private:
      std::mt19937_64 generator;
    };
  } // namespace Tests
} // namespace Catena

#endif

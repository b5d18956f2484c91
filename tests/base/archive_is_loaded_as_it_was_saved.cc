// Values, more of them than a piece of an archive holds, saved and loaded
// again, through a file in pieces, too.

#include <catena/base/archive.h>
#include <catena/base/checked_file.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

namespace
{
  struct Values
  {
    std::string                      text;
    std::vector<double>              numbers;
    std::vector<Point<3>>            points;
    std::vector<std::vector<double>> lists;
    bool                             flag  = false;
    std::uint8_t                     small = 0;

    void
    archive(Archive &archive)
    {
      archive(flag, text, numbers, small, points, lists);
    }

    bool
    operator==(const Values &other) const
    {
      return text == other.text && numbers == other.numbers &&
             points == other.points && lists == other.lists &&
             flag == other.flag && small == other.small;
    }
  };

  /// Their parts begin at odd places and go across several pieces.
  Values
  many_values()
  {
    Values values;
    values.text = std::string(1234567, 'x') + "end";
    values.numbers.resize(400001);
    std::iota(values.numbers.begin(), values.numbers.end(), 0.5);
    for (unsigned int i = 0; i < 50000; ++i)
      values.points.emplace_back(i, -2. * i, 1. / (1. + i));
    values.lists = {{}, {1., 2.}, std::vector<double>(200000, 3.)};
    values.flag  = true;
    values.small = 7;
    return values;
  }

  Values
  loaded(const std::string &bytes)
  {
    Archive archive(bytes);
    Values  values;
    archive(values);
    archive.finish();
    return values;
  }
} // namespace

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    Values  values = many_values();
    Archive archive;
    archive(values);
    const std::string bytes = archive.bytes();
    claims.holds("what is loaded is what was saved", loaded(bytes) == values);

    const std::vector<std::string> pieces = archive.take_pieces();
    claims.holds("it is in pieces", pieces.size() > 5);
    claims.holds("none of which is large",
                 std::all_of(pieces.begin(), pieces.end(), [](const auto &p) {
                   return !p.empty() && p.capacity() < (1U << 21);
                 }));
    claims.holds("and which are all of it",
                 std::accumulate(pieces.begin(), pieces.end(), std::string()) ==
                   bytes);
    claims.holds("nothing is left", archive.bytes().empty());

    CheckedFile::write("pieces", 1, pieces);
    claims.holds("a file in pieces has the same",
                 CheckedFile::read("pieces", 1) == bytes);
    bool is_refused = false;
    try
      {
        loaded(bytes.substr(0, bytes.size() / 2));
      }
    catch (const CheckpointError &)
      {
        is_refused = true;
      }
    claims.holds("half of it is refused", is_refused);
  });
}

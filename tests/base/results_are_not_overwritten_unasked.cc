// An output directory that holds files is refused unless overwriting is asked
// for, and nothing in it is deleted.

#include <catena/base/exceptions.h>
#include <catena/base/program_options.h>

#include <filesystem>
#include <fstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  bool
  is_refused(const std::string &directory, const bool overwrite)
  {
    try
      {
        prepare_output_directory(directory, overwrite, MPI_COMM_SELF);
        return false;
      }
    catch (const InputError &error)
      {
        const std::string message = error.what();
        return message.find(directory) != std::string::npos &&
               message.find('\n') == std::string::npos;
      }
  }



  void
  test(Tests::Claims &claims)
  {
    const std::string directory = "overwrite_test/results";
    const std::string result    = directory + "/result.txt";
    std::filesystem::remove_all("overwrite_test");

    claims.holds("new directory is made",
                 !is_refused(directory, false) &&
                   std::filesystem::is_directory(directory));
    claims.holds("empty directory is fine", !is_refused(directory, false));

    std::ofstream(result) << "result\n";
    claims.holds("full directory is refused", is_refused(directory, false));
    claims.holds("unless overwriting is asked for",
                 !is_refused(directory, true));
    claims.holds("nothing is deleted", std::filesystem::exists(result));
    claims.holds("a file is no directory", is_refused(result, true));

    std::filesystem::remove_all("overwrite_test");
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

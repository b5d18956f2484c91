// What is done in a child process returns its result, of any length; if it
// throws, crashes or hangs, that is an error with a message and nothing else.

#include <catena/base/child_process.h>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "../tests.h"

using namespace Catena;

namespace
{
  std::string
  failure(const std::function<std::string()> &work, const double seconds = 60.)
  {
    try
      {
        run_in_child(work, seconds);
      }
    catch (const ChildError &error)
      {
        std::cout << error.what() << std::endl;
        return error.what();
      }
    return "";
  }



  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }



  double
  seconds_of(const std::function<void()> &work)
  {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         begin)
      .count();
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    claims.holds("a result comes back",
                 run_in_child([]() { return "result"; }, 60.) == "result");
    claims.holds("also none",
                 run_in_child([]() { return std::string(); }, 60.).empty());
    const std::string large(10000000, 'x');
    claims.holds("also a large one",
                 run_in_child([&]() { return large; }, 60.) == large);
    int number = 1;
    run_in_child(
      [&]() {
        number = 2;
        return "";
      },
      60.);
    claims.near("nothing is changed here", number, 1., 0.);

    claims.holds("an exception comes back",
                 contains(failure([]() -> std::string {
                            throw std::runtime_error("out of luck");
                          }),
                          "out of luck"));
    claims.holds("so does one of gmsh",
                 contains(failure(
                            []() -> std::string { throw std::string("gmsh"); }),
                          "gmsh"));
    claims.holds("a crash is an error",
                 contains(failure([]() -> std::string {
                            std::raise(SIGSEGV);
                            return "";
                          }),
                          "it ended by"));
    claims.holds("an exit is an error",
                 contains(failure([]() -> std::string { _exit(3); }),
                          "without a result"));
    double seconds = seconds_of([&]() {
      claims.holds("what hangs is ended",
                   contains(failure(
                              []() -> std::string {
                                while (true)
                                  usleep(1000);
                              },
                              0.3),
                            "longer than 0.3 s"));
    });
    claims.at_most("in time", seconds, 10.);
  });
}

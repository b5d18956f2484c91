// The parts of a run report add up to the time of the run; counters and notes
// are printed; the BLAS library is recognised.

#include <catena/base/exceptions.h>
#include <catena/output/run_report.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include "../tests.h"

using namespace Catena;

namespace
{
  void
  wait(const unsigned int milliseconds)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }



  std::string
  blas_of(const std::string &path)
  {
    std::istringstream maps("7f01-7f02 r-xp 0 08:01 1 /usr/lib/libm.so.6\n"
                            "7f03-7f04 r-xp 0 08:01 2 " +
                            path + "\n");
    return blas_library(maps);
  }



  bool
  has(const std::string &text, const std::string &word)
  {
    return text.find(word) != std::string::npos;
  }



  void
  test(Tests::Claims &claims)
  {
    RunReport report(MPI_COMM_WORLD);
    for (unsigned int i = 0; i < 2; ++i)
      {
        const auto step = report.step();
        {
          const auto timer = report.time("flow: solve");
          wait(30);
        }
        {
          const auto timer = report.time("mesh");
          wait(10);
        }
        report.count("linear iterations", 11);
      }
    report.note("elements", 100);
    report.note("elements", 123456);

    claims.at_least("time of a part", report.seconds("flow: solve"), 0.06);
    claims.at_least("time of another part", report.seconds("mesh"), 0.02);
    claims.near("steps", report.n_steps(), 2., 0.);
    claims.near("counter", report.counter("linear iterations"), 22., 0.);
    claims.near("counter never used", report.counter("remeshes"), 0., 0.);

    std::ostringstream text;
    report.print(text);
    for (const std::string word : {"flow: solve",
                                   "mesh",
                                   "other",
                                   "mean seconds a step",
                                   "linear iterations              22",
                                   "elements                       123456",
                                   "peak memory",
                                   "BLAS"})
      claims.holds("report has " + word, has(text.str(), word));
    claims.holds("replaced note is gone", !has(text.str(), " 100\n"));

    report.write(".");
    claims.holds("file", std::ifstream("run_report.txt").good());
    std::remove("run_report.txt");

    bool refused = false;
    try
      {
        report.write("nowhere");
      }
    catch (const Error &error)
      {
        refused = has(error.what(), "nowhere/run_report.txt");
      }
    claims.holds("missing directory", refused);

    const std::string lib = "/usr/lib/x86_64-linux-gnu/";
    claims.holds("OpenBLAS",
                 has(blas_of(lib + "openblas-serial/libblas.so.3"),
                     "OpenBLAS"));
    claims.holds("reference BLAS",
                 has(blas_of(lib + "blas/libblas.so.3.11.0"), "reference"));
    claims.holds("no BLAS", blas_of(lib + "libc.so.6") == "unknown");
    claims.holds("BLAS of this program", blas_library() != "unknown");
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

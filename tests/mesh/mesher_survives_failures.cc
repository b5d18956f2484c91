// An attempt at a mesh that throws, crashes or hangs is followed by another
// one; when all fail the last cause is told.

#include <catena/base/wall_clock.h>

#include <unistd.h>

#include <csignal>

#include "../tests.h"

#include "scenes.h"

using namespace Catena;

namespace
{
  double time_limit = 600.;



  template <int dim>
  unsigned int
  attempts_of(const std::function<void(const unsigned int)> &before_attempt)
  {
    MeshParameters parameters = Tests::resolution(12, 1);
    parameters.time_limit     = time_limit;
    return generate_mesh(Tests::three_particles<dim>(),
                         parameters,
                         before_attempt)
      .attempts;
  }



  void
  fail(const unsigned int attempt)
  {
    if (attempt == 1)
      throw MeshError("The mesher was made to fail.");
    if (attempt == 2)
      std::raise(SIGSEGV);
    if (attempt == 3)
      while (true)
        usleep(1000);
    if (attempt == 4)
      _exit(0);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const double begin = wall_clock();
    claims.near("one attempt is enough in 2D", attempts_of<2>({}), 1., 0.);
    claims.near("and in 3D", attempts_of<3>({}), 1., 0.);
    // well above what a mesh takes, also under a tool that looks at memory
    time_limit = 2. + 5. * (wall_clock() - begin);

    claims.near("in 2D the fifth mesh is taken", attempts_of<2>(fail), 5., 0.);
    claims.near("in 3D as well", attempts_of<3>(fail), 5., 0.);
    std::string message;
    try
      {
        attempts_of<2>(
          [](const unsigned int) { throw MeshError("This never works."); });
      }
    catch (const MeshError &error)
      {
        message = error.what();
      }
    std::cout << message << std::endl;
    claims.holds("when all fail the last cause is told",
                 message.find("in 8 attempts") != std::string::npos &&
                   message.find("never works") != std::string::npos);
  });
}

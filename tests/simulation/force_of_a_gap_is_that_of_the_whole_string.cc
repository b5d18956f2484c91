// The table of a run tells the force of one gap: of three discs that are
// pressed together it is the same where half of the box is meshed, with one
// gap, and where all of it is, with two.

#include <catena/simulation/run.h>

#include <array>
#include <sstream>

#include "../tests.h"

#include "three_discs.h"

using namespace Catena;

namespace
{
  struct Row
  {
    double force = 0., n_held = 0.;
  };



  /// The last row of a table.
  Row
  last_row(const std::string &path)
  {
    std::ifstream file(path);
    std::string   names, line, last;
    std::getline(file, names);
    while (std::getline(file, line))
      last = line;
    std::istringstream name(names), number(last);
    Row                row;
    while (std::getline(name, names, ',') && std::getline(number, line, ','))
      {
        if (names == "F_r [F_S]")
          row.force = std::stod(line);
        if (names == "held_contacts")
          row.n_held = std::stod(line);
      }
    return row;
  }



  Scene<2>
  whole_box()
  {
    Scene<2> scene             = Tests::close_discs();
    scene.symmetry             = Symmetry::none;
    scene.particles[0].on_axis = false;
    scene.particles.push_back({-1. * scene.particles[1].centre});
    scene.line = std::array<unsigned int, 2>{{1, 2}};
    return scene;
  }



  Row
  end_of(const Scene<2> &scene, const std::string &folder)
  {
    auto parameters         = Tests::three_discs_parameters(0.4, 0.08);
    parameters.fluid.model  = FluidParameters::Model::newtonian;
    parameters.minimal_gap  = 0.11;
    parameters.final_strain = 2.;
    const SimulationParameters usual;
    parameters.remesh_quality = usual.remesh_quality;
    run_simulation<2>(scene, parameters, {folder, true, false}, MPI_COMM_WORLD);
    return last_row(folder + "/trajectory.csv");
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](auto &claims) {
    const Row half = end_of(Tests::close_discs(), "half");
    const Row all  = end_of(whole_box(), "all");
    claims.near("half of the box has one gap", half.n_held, 1., 0.);
    claims.near("all of it has two", all.n_held, 2., 0.);
    claims.at_least("the force is not small", half.force, 0.05);
    claims.near("and the same", all.force / half.force, 1., 0.03);
  });
}

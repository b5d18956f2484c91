// A checkpoint that is damaged, of another version or of another run is refused
// in one line, and the one before is used where there is one. Thousands of
// random damages are all found. Nothing but the end of the table is touched.

#include <catena/base/checked_file.h>
#include <catena/base/error_text.h>
#include <catena/simulation/run.h>

#include <deal.II/base/exceptions.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "../tests.h"

#include "../base/mutations.h"
#include "three_discs.h"

using namespace Catena;

namespace
{
  const std::string folder = "run";

  SimulationParameters
  run_parameters()
  {
    auto parameters         = Tests::three_discs_parameters(0.5, 0.1);
    parameters.fluid.model  = FluidParameters::Model::newtonian;
    parameters.final_strain = 0.4;
    parameters.checkpoint.strain_interval = 0.1;
    return parameters;
  }



  void
  run(const SimulationParameters &parameters,
      const bool                  resume,
      const Scene<2>             &scene = Tests::three_discs())
  {
    // the report on the screen is of no interest
    std::ostringstream dark;
    auto *const        screen = std::cout.rdbuf(dark.rdbuf());
    try
      {
        run_simulation<2>(scene,
                          parameters,
                          {folder, false, resume},
                          MPI_COMM_WORLD);
      }
    catch (...)
      {
        std::cout.rdbuf(screen);
        throw;
      }
    std::cout.rdbuf(screen);
  }



  /// What @p attempt is refused with; empty if it is not refused.
  std::string
  refusal(const std::function<void()> &attempt)
  {
    try
      {
        attempt();
      }
    catch (const Error &error)
      {
        const std::string message = error.what();
        std::cout << message << std::endl;
        return message.find('\n') == std::string::npos ? message :
                                                         "several lines";
      }
    return "";
  }



  bool
  says(const std::string &message, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      if (message.find(part) == std::string::npos)
        return false;
    return true;
  }



  std::string
  read_file(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }



  void
  write_file(const std::string &path, const std::string &bytes)
  {
    std::ofstream(path, std::ios::binary) << bytes;
  }



  /// The number of rows of the table, and whether each strain is there once.
  unsigned int
  n_rows(const std::string &path)
  {
    std::ifstream file(path);
    std::string   line;
    std::getline(file, line);
    unsigned int n    = 0;
    double       last = -1e30;
    while (std::getline(file, line))
      {
        const double strain = std::stod(line);
        n += strain > last ? 1 : 1000;
        last = strain;
      }
    return n;
  }



  void
  test_damage(Tests::Claims &claims)
  {
    const std::string path    = folder + "/checkpoint_0";
    const std::string whole   = read_file(path);
    const std::string content = CheckedFile::read(path, Checkpoint::version);

    constexpr unsigned int n = 5000;
    Tests::Mutations       mutations(7);
    unsigned int           n_refused = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        // the header more often than by chance
        const std::string damaged =
          i % 4 == 0 ?
            mutations.damaged(whole.substr(0, 40)) + whole.substr(40) :
            mutations.damaged(whole);
        write_file("damaged", damaged);
        try
          {
            CheckedFile::read("damaged", Checkpoint::version);
          }
        catch (const CheckpointError &)
          {
            ++n_refused;
          }
      }
    claims.near("all of 5000 damaged checkpoints are refused",
                n_refused,
                n,
                0.);

    CheckedFile::write("other", Checkpoint::version + 1, {content});
    claims.holds("another version is refused by its number",
                 says(refusal([]() {
                        CheckedFile::read("other", Checkpoint::version);
                      }),
                      {"version " + std::to_string(Checkpoint::version + 1),
                       "reads " + std::to_string(Checkpoint::version)}));
    claims.holds("a folder is refused",
                 says(refusal([]() {
                        CheckedFile::read(folder, Checkpoint::version);
                      }),
                      {"cannot be read"}));
    claims.holds("what cannot be written is refused",
                 says(refusal([]() {
                        CheckedFile::write("nowhere/file", 1, {"content"});
                      }),
                      {"nowhere/file", "cannot be written"}));
  }



  /**
   * Contents with random damage but the right checksum, as no disk makes them.
   * Some differ in numbers only, which nothing can tell.
   */
  void
  load(const std::string &bytes, const SimulationParameters &parameters)
  {
    Simulation<2> simulation(Tests::three_discs(), parameters, MPI_COMM_WORLD);
    Archive       archive(bytes);
    simulation.archive(archive);
    archive.finish();
  }



  void
  test_content(Tests::Claims &claims, const FluidParameters::Model model)
  {
    auto parameters        = run_parameters();
    parameters.fluid.model = model;
    std::string bytes;
    {
      Simulation<2> simulation(Tests::three_discs(),
                               parameters,
                               MPI_COMM_WORLD);
      simulation.initialize();
      simulation.advance();
      Archive archive;
      simulation.archive(archive);
      bytes = archive.bytes();
    }
    claims.holds("the content itself is loaded",
                 refusal([&]() { load(bytes, parameters); }).empty());
    Tests::Mutations mutations(11);
    unsigned int     n_loaded = 0, n_refused = 0;
    for (unsigned int i = 0; i < 200; ++i)
      {
        // lengths and flags are at the beginning
        const std::string damaged =
          i % 2 == 0 ?
            mutations.damaged(bytes.substr(0, 400)) + bytes.substr(400) :
            mutations.damaged(bytes);
        try
          {
            load(damaged, parameters);
            ++n_loaded;
          }
        catch (const std::exception &)
          {
            ++n_refused;
          }
      }
    std::cout << n_loaded << " loaded, " << n_refused << " refused"
              << std::endl;
    claims.near("no damaged content ends the program",
                n_loaded + n_refused,
                200.,
                0.);
  }



  void
  test_resume(Tests::Claims &claims)
  {
    auto parameters = run_parameters();
    claims.holds("a folder with a run is refused",
                 says(refusal([&]() { run(parameters, false); }),
                      {"output directory", "--overwrite"}));

    auto other                   = parameters;
    other.step_control.time_step = 0.05;
    claims.holds("another time step is refused by name",
                 says(refusal([&]() { run(other, true); }),
                      {"'Time / Time step' = 0.05", "0.1"}));
    other                          = parameters;
    other.mesh.elements_across_gap = 2;
    claims.holds("another mesh is refused by name",
                 says(refusal([&]() { run(other, true); }),
                      {"'Mesh / Elements across gap' = 2"}));
    auto moved = Tests::three_discs();
    moved.particles[1].centre[0] += 0.1;
    claims.holds("other particles are refused by name",
                 says(refusal([&]() { run(parameters, true, moved); }),
                      {"place of particle 1"}));

    parameters.final_strain          = 0.6;
    parameters.flow_solver.tolerance = 1e-9;
    run(parameters, true);
    claims.near("a longer run goes on, each row once",
                n_rows(folder + "/trajectory.csv"),
                7.,
                0.);

    // as if the run had been killed while it wrote
    std::ofstream(folder + "/trajectory.csv", std::ios::app) << "0.7,0.1,half";
    std::ofstream(folder + "/checkpoint_0.part") << "half";
    parameters.final_strain = 0.8;
    run(parameters, true);
    claims.near("half a row is replaced",
                n_rows(folder + "/trajectory.csv"),
                9.,
                0.);

    const std::string newest =
      std::filesystem::last_write_time(folder + "/checkpoint_0") >
          std::filesystem::last_write_time(folder + "/checkpoint_1") ?
        "/checkpoint_0" :
        "/checkpoint_1";
    const std::string whole = read_file(folder + newest);
    write_file(folder + newest, whole.substr(0, whole.size() / 2));
    parameters.final_strain = 1.;
    run(parameters, true);
    claims.near("the last but one is used if the last one is damaged",
                n_rows(folder + "/trajectory.csv"),
                11.,
                0.);

    const std::string table = read_file(folder + "/trajectory.csv");
    write_file(folder + "/trajectory.csv", table.substr(0, table.size() / 2));
    claims.holds("a table that has lost rows is refused",
                 says(refusal([&]() { run(parameters, true); }),
                      {"trajectory.csv", "put it back"}));
    for (const std::string slot : {"/checkpoint_0", "/checkpoint_1"})
      write_file(folder + slot, "nothing");
    claims.holds("two damaged checkpoints are refused",
                 says(refusal([&]() { run(parameters, true); }),
                      {"checkpoint_0", "checkpoint_1", "too short"}));
    for (const std::string slot : {"/checkpoint_0", "/checkpoint_1"})
      std::filesystem::remove(folder + slot);
    claims.holds("no checkpoint is said to be none",
                 says(refusal([&]() { run(parameters, true); }),
                      {"There is no checkpoint", "without --resume"}));
  }
} // namespace



int
main(int argc, char **argv)
{
  // a Debug build finds damage by its assertions as well
  dealii::deal_II_exceptions::disable_abort_on_exception();
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    std::filesystem::remove_all(folder);
    run(run_parameters(), false);
    test_damage(claims);
    test_content(claims, FluidParameters::Model::newtonian);
    test_content(claims, FluidParameters::Model::giesekus);
    test_resume(claims);
  });
}

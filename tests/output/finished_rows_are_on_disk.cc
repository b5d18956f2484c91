// A trajectory table names its columns and units, refuses incomplete rows,
// holds every finished row at once, and reports a full disk.

#include <catena/base/exceptions.h>
#include <catena/output/trajectory_table.h>

#include <deal.II/base/exceptions.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  const std::string file_name = "finished_rows.csv";

  std::string
  content()
  {
    std::ifstream     file(file_name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }



  template <typename Exception>
  bool
  throws(const std::function<void()> &action, const std::string &word)
  {
    try
      {
        action();
      }
    catch (const Exception &error)
      {
        return std::string(error.what()).find(word) != std::string::npos;
      }
    return false;
  }



  void
  add_row(TrajectoryTable &table, const double strain, const double theta)
  {
    table.add("strain", strain);
    table.add("theta", theta);
    table.write_row();
  }



  void
  test(Tests::Claims &claims)
  {
    TrajectoryTable table(file_name, MPI_COMM_WORLD);
    table.declare("strain");
    table.declare("theta", "deg");
    add_row(table, 0., 10.);
    add_row(table, 1. / 3., -1.23456789012e-7);

    claims.holds("header, and rows while the table is open",
                 content() == "strain,theta [deg]\n"
                              "0,10\n"
                              "0.3333333333,-1.23456789e-07\n");

    table.add("strain", 1.);
    using dealii::ExceptionBase;
    claims.holds("incomplete row",
                 throws<ExceptionBase>([&]() { table.write_row(); }, "theta"));
    claims.holds("value given twice",
                 throws<ExceptionBase>([&]() { add_row(table, 1., 1.); },
                                       "strain"));
    claims.holds("unknown column",
                 throws<ExceptionBase>([&]() { table.add("gap", 1.); }, "gap"));
    claims.holds("column after the first row",
                 throws<ExceptionBase>([&]() { table.declare("gap"); }, "gap"));
    claims.near("rows", table.n_rows(), 2., 0.);

    claims.holds("missing directory",
                 throws<Error>(
                   []() {
                     TrajectoryTable("nowhere/table.csv", MPI_COMM_WORLD);
                   },
                   "nowhere/table.csv"));

    TrajectoryTable on_full_disk("/dev/full", MPI_COMM_WORLD);
    on_full_disk.declare("strain");
    on_full_disk.declare("theta");
    claims.holds("full disk",
                 throws<Error>([&]() { add_row(on_full_disk, 1., 1.); },
                               "/dev/full"));

    std::remove(file_name.c_str());
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

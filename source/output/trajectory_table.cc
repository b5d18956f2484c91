#include <catena/base/exceptions.h>
#include <catena/output/trajectory_table.h>

#include <deal.II/base/exceptions.h>

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  TrajectoryTable::TrajectoryTable(const std::string &path,
                                   const MPI_Comm     communicator,
                                   const unsigned int n_digits)
    : path(path)
    , communicator(communicator)
    , n_digits(n_digits)
  {
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      file.open(path, std::ios::trunc);
    check_file("cannot be opened for writing: check that its directory exists "
               "and is yours");
  }



  namespace
  {
    /// Why rows cannot follow after byte @p end of @p path; empty if they can.
    std::string
    cut(const std::string &path, const std::uint64_t end)
    {
      std::error_code error;
      const auto      size = std::filesystem::file_size(path, error);
      if (error)
        return "cannot be read (" + error.message() + ")";
      std::ifstream file(path, std::ios::binary);
      file.seekg(end > 0 ? end - 1 : 0);
      if (size < end || (end > 0 && file.get() != '\n'))
        return "is not as it was at the checkpoint: put it back, or start "
               "anew with another --output";
      file.close();
      std::filesystem::resize_file(path, end, error);
      return error ? "cannot be written (" + error.message() + ")" : "";
    }
  } // namespace



  TrajectoryTable::TrajectoryTable(const std::string &path,
                                   const MPI_Comm     communicator,
                                   const Position    &position,
                                   const unsigned int n_digits)
    : path(path)
    , communicator(communicator)
    , n_digits(n_digits)
    , rows_written(position.rows)
  {
    std::string failure;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        failure = cut(path, position.bytes);
        if (failure.empty())
          file.open(path, std::ios::app);
      }
    failure = Utilities::MPI::broadcast(communicator, failure, 0);
    if (!failure.empty())
      throw Error("File '" + path + "' " + failure + ".");
    check_file("cannot be opened for writing: check that its directory exists "
               "and is yours");
  }



  void
  TrajectoryTable::declare(const std::string &name, const std::string &unit)
  {
    AssertThrow(!row_begun,
                ExcMessage("Column '" + name +
                           "' is declared after the first row."));
    AssertThrow(!name.empty() &&
                  (name + unit).find_first_of(",\n\r\"") == std::string::npos,
                ExcMessage("'" + name + "' cannot be the name of a column."));
    AssertThrow(index_of.count(name) == 0,
                ExcMessage("Column '" + name + "' is declared twice."));

    index_of[name] = columns.size();
    columns.emplace_back();
    columns.back().heading = unit.empty() ? name : name + " [" + unit + "]";
  }



  void
  TrajectoryTable::add(const std::string &name, const double value)
  {
    const auto position = index_of.find(name);
    AssertThrow(position != index_of.end(),
                ExcMessage("There is no column '" + name + "'."));

    row_begun      = true;
    Column &column = columns[position->second];
    AssertThrow(!column.is_set,
                ExcMessage("Column '" + name + "' has a value in this row."));
    column.value  = value;
    column.is_set = true;
  }



  void
  TrajectoryTable::write_row()
  {
    std::ostringstream text;
    text.precision(n_digits);

    if (rows_written == 0)
      for (const Column &column : columns)
        text << column.heading << (&column == &columns.back() ? "\n" : ",");

    for (const Column &column : columns)
      {
        AssertThrow(column.is_set,
                    ExcMessage("Column '" + column.heading +
                               "' has no value in this row."));
        text << column.value << (&column == &columns.back() ? "\n" : ",");
      }
    for (Column &column : columns)
      column.is_set = false;

    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      file << text.str() << std::flush;
    check_file("cannot be written: is the disk full?");
    ++rows_written;
  }



  TrajectoryTable::Position
  TrajectoryTable::sync()
  {
    Position position;
    position.rows = rows_written;
    bool good     = true;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        file.flush();
        const int descriptor = open(path.c_str(), O_RDONLY);
        good = file.good() && descriptor >= 0 && fsync(descriptor) == 0;
        if (descriptor >= 0)
          close(descriptor);
        std::error_code error;
        position.bytes = std::filesystem::file_size(path, error);
        good           = good && !error;
      }
    if (!Utilities::MPI::broadcast(communicator, good, 0))
      throw Error("File '" + path + "' cannot be written: is the disk full?");
    return position;
  }



  unsigned int
  TrajectoryTable::n_rows() const
  {
    return rows_written;
  }



  void
  TrajectoryTable::check_file(const std::string &what_failed) const
  {
    const bool good = Utilities::MPI::broadcast(communicator, file.good(), 0);
    if (!good)
      throw Error("File '" + path + "' " + what_failed + ".");
  }
} // namespace Catena

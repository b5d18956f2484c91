#ifndef catena_tests_tests_h
#define catena_tests_tests_h

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace Catena
{
  namespace Tests
  {
    /**
     * The claims of a test: sentences that hold or fail. The file `output`,
     * which is compared with the recorded one, gets the sentence and the
     * verdict only, so that it is the same on every machine; the numbers behind
     * them are printed (`ctest -V`, or `stdout` in the folder of the test).
     * Values that are not finite fail. Under MPI the first process writes.
     */
    class Claims
    {
    public:
      Claims()
      {
        if (is_first_process())
          output.open("output");
        std::cout.precision(12);
      }

      /// value <= bound
      bool
      at_most(const std::string &claim, const double value, const double bound)
      {
        return record(
          claim, std::isfinite(value) && value <= bound, value, " <= ", bound);
      }

      /// value >= bound
      bool
      at_least(const std::string &claim, const double value, const double bound)
      {
        return record(
          claim, std::isfinite(value) && value >= bound, value, " >= ", bound);
      }

      /// |value - expected| <= tolerance
      bool
      near(const std::string &claim,
           const double       value,
           const double       expected,
           const double       tolerance)
      {
        const double difference = std::abs(value - expected);
        return record(claim,
                      std::isfinite(difference) && difference <= tolerance,
                      value,
                      " = ",
                      expected,
                      ", difference ",
                      difference,
                      " <= ",
                      tolerance);
      }

      bool
      holds(const std::string &claim, const bool condition)
      {
        return record(claim, condition);
      }

      /**
       * What main() returns: 0 if there were claims and all held, on every
       * process.
       */
      int
      exit_code() const
      {
        const unsigned int failed = (n_claims == 0 || n_failures > 0) ? 1U : 0U;
        return static_cast<int>(
          dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD));
      }

    private:
      static bool
      is_first_process()
      {
        return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      }

      template <typename... Numbers>
      bool
      record(const std::string &claim,
             const bool         verdict,
             const Numbers &...numbers)
      {
        ++n_claims;
        n_failures += verdict ? 0 : 1;

        const std::string line = claim + (verdict ? ": holds" : ": FAILS");
        if (is_first_process())
          {
            output << line << std::endl;
            std::cout << line;
            if constexpr (sizeof...(numbers) > 0)
              {
                std::cout << "  [";
                (std::cout << ... << numbers) << ']';
              }
            std::cout << std::endl;
          }
        return verdict;
      }

      std::ofstream output;
      unsigned int  n_claims   = 0;
      unsigned int  n_failures = 0;
    };


    /**
     * The main() of a test: sets up MPI with one thread a process, calls
     * test(claims) and returns the exit code. An exception fails the test.
     */
    template <typename Test>
    int
    run(int argc, char **argv, const Test &test)
    {
      const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      try
        {
          Claims claims;
          test(claims);
          return claims.exit_code();
        }
      catch (const std::exception &exception)
        {
          std::cerr << exception.what() << std::endl;
        }
      catch (const std::string &message) // as gmsh throws them
        {
          std::cerr << message << std::endl;
        }
      // Another process may wait for this one: do not leave in good order.
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, 1);
      return 1;
    }


    /**
     * A table with named columns. Cells that are no numbers are NaN in
     * `numbers`; all cells are in `text` as they stand in the file.
     */
    struct Table
    {
      std::map<std::string, std::vector<double>>      numbers;
      std::map<std::string, std::vector<std::string>> text;
      unsigned int                                    n_rows = 0;

      /// A column of numbers, by the name in the header
      const std::vector<double> &
      operator[](const std::string &column) const
      {
        const auto found = numbers.find(column);
        if (found == numbers.end())
          throw std::runtime_error("The table has no column '" + column + "'.");
        return found->second;
      }
    };


    /// The cells of a line of a CSV file; quoted cells may contain commas.
    inline std::vector<std::string>
    split_csv_line(const std::string &line)
    {
      std::vector<std::string> cells(1);
      bool                     quoted = false;
      for (const char c : line)
        if (c == '"')
          quoted = !quoted;
        else if (c == ',' && !quoted)
          cells.emplace_back();
        else if (c != '\r')
          cells.back() += c;
      return cells;
    }


    /**
     * Read a CSV file with a header. A relative @p path starts at
     * tests/reference. Empty lines and lines that start with # are skipped.
     */
    inline Table
    read_table(const std::string &path)
    {
      const std::string file_name =
        path.front() == '/' ? path : CATENA_TEST_DATA "/" + path;
      std::ifstream file(file_name);
      if (!file)
        throw std::runtime_error("Cannot read the table " + file_name);

      Table                    table;
      std::vector<std::string> header;
      for (std::string line; std::getline(file, line);)
        {
          if (line.empty() || line[0] == '#')
            continue;
          const auto cells = split_csv_line(line);
          if (header.empty())
            {
              header = cells;
              continue;
            }
          if (cells.size() != header.size())
            throw std::runtime_error(
              file_name + ": a row has " + std::to_string(cells.size()) +
              " cells, the header " + std::to_string(header.size()) + ": " +
              line);
          for (std::size_t i = 0; i < cells.size(); ++i)
            {
              std::istringstream stream(cells[i]);
              double             number = 0.;
              const bool         is_number =
                (stream >> number) && (stream >> std::ws).eof();
              table.numbers[header[i]].push_back(
                is_number ? number : std::numeric_limits<double>::quiet_NaN());
              table.text[header[i]].push_back(cells[i]);
            }
          ++table.n_rows;
        }
      return table;
    }
  } // namespace Tests
} // namespace Catena

#endif

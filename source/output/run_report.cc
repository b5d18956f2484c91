#include <catena/base/wall_clock.h>
#include <catena/base/whole_file.h>
#include <catena/output/progress.h>
#include <catena/output/run_report.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <iomanip>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    template <typename List>
    auto
    find_entry(List &list, const std::string &name)
    {
      return std::find_if(list.begin(), list.end(), [&name](const auto &entry) {
        return entry.first == name;
      });
    }



    /**
     * Width of the column of names.
     */
    constexpr int name_width = 30;



    template <typename T>
    void
    print_entry(std::ostream &out, const std::string &name, const T &value)
    {
      out << "  " << std::left << std::setw(name_width) << name << ' ' << value
          << '\n';
    }



    /**
     * @p value with three digits.
     */
    std::string
    digits(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(3) << value;
      return text.str();
    }



    /**
     * Largest memory this process has used, in GB.
     */
    double
    peak_memory()
    {
      Utilities::System::MemoryStats stats;
      Utilities::System::get_memory_stats(stats);
      return stats.VmHWM / (1024. * 1024.);
    }
  } // namespace



  std::string
  blas_library(std::istream &maps)
  {
    const std::vector<std::pair<std::string, std::string>> names = {
      {"openblas-pthread", "OpenBLAS (threaded)"},
      {"openblas-openmp", "OpenBLAS (OpenMP)"},
      {"openblas-serial", "OpenBLAS (serial)"},
      {"openblas", "OpenBLAS"},
      {"libmkl", "Intel MKL"},
      {"blis", "BLIS"},
      {"atlas", "ATLAS"},
      {"libblas.so", "reference (slow: install libopenblas0-serial)"}};

    std::size_t best = names.size();
    for (std::string line; std::getline(maps, line);)
      for (std::size_t i = 0; i < best; ++i)
        if (line.find('/') != std::string::npos &&
            line.find(names[i].first, line.find('/')) != std::string::npos)
          best = i;

    return best < names.size() ? names[best].second : "unknown";
  }



  std::string
  blas_library()
  {
    std::ifstream maps("/proc/self/maps");
    return blas_library(maps);
  }



  RunReport::Timer::Timer(double &seconds)
    : seconds(seconds)
    , begin(wall_clock())
  {}



  RunReport::Timer::~Timer()
  {
    seconds += wall_clock() - begin;
  }



  RunReport::RunReport(const MPI_Comm communicator)
    : communicator(communicator)
    , begin(wall_clock())
  {}



  RunReport::Timer
  RunReport::time(const std::string &part)
  {
    auto entry = find_entry(parts, part);
    if (entry == parts.end())
      entry = parts.emplace(entry, part, std::make_unique<Part>());

    ++entry->second->calls;
    return Timer(entry->second->seconds);
  }



  RunReport::Timer
  RunReport::step()
  {
    ++steps.calls;
    return Timer(steps.seconds);
  }



  unsigned long
  RunReport::n_steps() const
  {
    return steps.calls;
  }



  double
  RunReport::seconds(const std::string &part) const
  {
    const auto entry = find_entry(parts, part);
    return entry == parts.end() ? 0. : entry->second->seconds;
  }



  void
  RunReport::count(const std::string &name, const unsigned long n)
  {
    auto entry = find_entry(counters, name);
    if (entry == counters.end())
      entry = counters.emplace(entry, name, 0);
    entry->second += n;
  }



  unsigned long
  RunReport::counter(const std::string &name) const
  {
    const auto entry = find_entry(counters, name);
    return entry == counters.end() ? 0 : entry->second;
  }



  void
  RunReport::set_note(const std::string &name, const std::string &value)
  {
    auto entry = find_entry(notes, name);
    if (entry == notes.end())
      entry = notes.emplace(entry, name, "");
    entry->second = value;
  }



  void
  RunReport::archive(Archive &archive)
  {
    std::vector<std::string>   names;
    std::vector<unsigned long> values;
    for (const auto &[name, value] : counters)
      {
        names.push_back(name);
        values.push_back(value);
      }
    archive(steps.calls, steps.seconds, names, values);
    if (names.size() != values.size())
      throw CheckpointError("it has counters without a name");
    counters.clear();
    for (unsigned int i = 0; i < names.size(); ++i)
      counters.emplace_back(names[i], values[i]);
  }



  void
  RunReport::print(std::ostream &out) const
  {
    const std::string text = table();
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      out << text << std::flush;
  }



  void
  RunReport::write(const std::string &directory) const
  {
    const std::string path = directory + "/run_report.txt";
    const std::string text = table();

    int error = 0;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      error = WholeFile::write(path, [&](std::ostream &file) { file << text; });
    if (Utilities::MPI::broadcast(communicator, error) != 0)
      throw Error("File '" + path + "' cannot be written: is the disk full?");
  }



  std::string
  RunReport::table() const
  {
    const double total  = wall_clock() - begin;
    const double memory = Utilities::MPI::sum(peak_memory(), communicator);

    std::ostringstream out;
    print_times(out, total);

    out << "Counts\n";
    print_entry(out, "steps", steps.calls);
    if (steps.calls > 0)
      print_entry(out,
                  "mean seconds a step",
                  digits(steps.seconds / steps.calls));
    for (const auto &[name, value] : counters)
      print_entry(out, name, value);

    out << "Size\n";
    for (const auto &[name, value] : notes)
      print_entry(out, name, value);

    print_entry(out, "peak memory", digits(memory) + " GB");
    print_entry(out,
                "processes x threads",
                std::to_string(Utilities::MPI::n_mpi_processes(communicator)) +
                  " x " + std::to_string(MultithreadInfo::n_threads()));
    print_entry(out, "BLAS", blas_library());
    return out.str();
  }



  void
  RunReport::print_times(std::ostream &out, const double total) const
  {
    const auto print_part = [&](const std::string &name,
                                const double       seconds,
                                const std::string &calls) {
      out << "  " << std::left << std::setw(name_width) << name << std::right
          << std::fixed << std::setprecision(2) << std::setw(10) << seconds
          << " s" << std::setprecision(1) << std::setw(7)
          << 100. * seconds / total << " %" << calls << '\n';
    };

    double rest = total;
    out << "Time, " << duration_in_words(total) << '\n';
    for (const auto &[name, part] : parts)
      {
        print_part(name,
                   part->seconds,
                   "  " + std::to_string(part->calls) + " times");
        rest -= part->seconds;
      }
    print_part("other", rest, "");
  }
} // namespace Catena

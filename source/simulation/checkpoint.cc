#include <catena/base/archive.h>
#include <catena/base/checked_file.h>
#include <catena/simulation/checkpoint.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace Catena
{
  using namespace dealii;

  void
  CheckpointParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Enabled",
                      enabled,
                      "Write checkpoints, from which a run goes on with "
                      "--resume: at the start, at the end, at the signals "
                      "SIGTERM, SIGINT and SIGUSR1, and as below.");
    prm.add_parameter("Strain interval",
                      strain_interval,
                      "Strain between two checkpoints; 0 for none by strain.",
                      Patterns::Double());
    prm.add_parameter("Wall time interval",
                      wall_time_interval,
                      "Wall time between two checkpoints [min]; 0 for none by "
                      "time.",
                      Patterns::Double());
  }



  void
  CheckpointParameters::check() const
  {
    require(strain_interval >= 0. && std::isfinite(strain_interval),
            "Checkpoint/Strain interval",
            strain_interval,
            "give a strain that is not negative");
    require(wall_time_interval >= 0. && std::isfinite(wall_time_interval),
            "Checkpoint/Wall time interval",
            wall_time_interval,
            "give a time in minutes that is not negative");
  }



  namespace
  {
    /// The bytes of rank 0, in pieces whose length fits an int.
    std::string
    on_all_ranks(std::string bytes, const MPI_Comm communicator)
    {
      constexpr std::uint64_t piece = 1 << 30;

      std::uint64_t size = bytes.size();
      MPI_Bcast(&size, 1, MPI_UINT64_T, 0, communicator);
      bytes.resize(size);
      for (std::uint64_t begin = 0; begin < size; begin += piece)
        MPI_Bcast(bytes.data() + begin,
                  static_cast<int>(std::min(piece, size - begin)),
                  MPI_CHAR,
                  0,
                  communicator);
      return bytes;
    }
  } // namespace



  Checkpoint::Checkpoint(const std::string &directory,
                         const MPI_Comm     communicator)
    : directory(directory)
    , communicator(communicator)
  {}



  std::string
  Checkpoint::slot(const std::uint64_t number) const
  {
    return directory + "/checkpoint_" + std::to_string(number % 2);
  }



  bool
  Checkpoint::exists() const
  {
    return Utilities::MPI::broadcast(communicator,
                                     std::filesystem::exists(slot(0)) ||
                                       std::filesystem::exists(slot(1)));
  }



  void
  Checkpoint::clear()
  {
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      for (const std::uint64_t n : {0, 1})
        std::remove(slot(n).c_str());
    number      = 0;
    last_strain = {};
  }



  void
  Checkpoint::write(std::vector<std::string> pieces, const double strain)
  {
    std::string   failure;
    std::uint64_t next = number + 1;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          double  at = strain;
          Archive head;
          head(next, at);
          pieces.insert(pieces.begin(), head.bytes());
          CheckedFile::write(slot(next), version, pieces);
        }
      catch (const CheckpointError &error)
        {
          failure = error.what();
        }
    failure = Utilities::MPI::broadcast(communicator, failure);
    if (!failure.empty())
      throw CheckpointError(failure);
    number      = next;
    last_strain = strain;
  }



  /// The content of the slot with the largest number, on rank 0.
  std::string
  Checkpoint::newest()
  {
    std::string best, failures;
    for (const std::uint64_t n : {0, 1})
      try
        {
          std::error_code unreadable;
          if (!std::filesystem::exists(slot(n), unreadable))
            continue;
          std::string           bytes = CheckedFile::read(slot(n), version);
          std::uint64_t         found;
          double                strain;
          constexpr std::size_t head_length = sizeof(found) + sizeof(strain);
          Archive               head(bytes.substr(0, head_length));
          head(found, strain);
          if (best.empty() || found > number)
            {
              number      = found;
              last_strain = strain;
              best        = std::move(bytes.erase(0, head_length));
            }
        }
      catch (const CheckpointError &error)
        {
          failures +=
            (failures.empty() ? "" : "; ") + std::string(error.what());
        }
    if (best.empty())
      throw CheckpointError(
        failures.empty() ?
          "There is no checkpoint in '" + directory +
            "': start without --resume, with --overwrite if it holds files" :
          failures + ": start anew with another --output");
    return best;
  }



  std::string
  Checkpoint::read()
  {
    std::string content, failure;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          content = newest();
        }
      catch (const CheckpointError &error)
        {
          failure = error.what();
        }
    failure = Utilities::MPI::broadcast(communicator, failure);
    if (!failure.empty())
      throw CheckpointError(failure);
    number = Utilities::MPI::broadcast(communicator, number);
    last_strain =
      Utilities::MPI::broadcast(communicator, last_strain.value_or(0.));
    return on_all_ranks(std::move(content), communicator);
  }
} // namespace Catena

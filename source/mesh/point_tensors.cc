#include <catena/mesh/point_tensors.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    unsigned int
    n_points(const bool curved)
    {
      static const std::array<unsigned int, 2> counts = {
        {CellValues<dim>::rule(false).size(),
         CellValues<dim>::rule(true).size()}};
      return counts[curved];
    }

    template <int dim>
    unsigned int
    n_packs(const bool curved)
    {
      return (n_points<dim>(curved) + pack_size - 1) / pack_size;
    }
  } // namespace



  template <int dim, typename Number>
  PointTensors<dim, Number>::PointTensors(const MovingMesh<dim> &mesh)
  {
    begin.reserve(mesh.cells().size() + 1);
    begin.push_back(0);
    for (const Cell &cell : mesh.cells())
      begin.push_back(
        begin.back() +
        (cell.owned ? n_packs<dim>(cell.curved) * numbers_per_pack : 0));
    numbers.resize(begin.back());
  }



  template <int dim, typename Number>
  std::vector<SymmetricTensor<2, dim>>
  PointTensors<dim, Number>::of_cell(const Cell &cell) const
  {
    std::vector<SymmetricTensor<2, dim>> result(n_points<dim>(cell.curved));
    PackValues                           pack;
    for (pack.first = 0; pack.first < result.size(); pack.first += pack_size)
      {
        const Tensors tensors = get(cell, pack);
        for (unsigned int k = 0;
             k < pack_size && pack.first + k < result.size();
             ++k)
          result[pack.first + k] = lane<dim>(tensors, k);
      }
    return result;
  }



  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::archive(Archive               &archive,
                                     const MovingMesh<dim> &mesh)
  {
    if (archive.is_loading())
      load(archive, mesh);
    else
      save(archive, mesh);
  }



  /// By rank, its cells in the numbers of the description, how many numbers
  /// each has, and these one cell after the other.
  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::save(Archive               &archive,
                                  const MovingMesh<dim> &mesh) const
  {
    std::vector<unsigned int> owned, sizes;
    if (!empty())
      for (const Cell &cell : mesh.cells())
        if (cell.owned)
          {
            owned.push_back(cell.iterator->active_cell_index());
            sizes.push_back(begin[cell.index + 1] - begin[cell.index]);
          }
    const MPI_Comm comm  = mesh.communicator();
    auto           cells = Utilities::MPI::gather(comm, owned, 0),
         counts          = Utilities::MPI::gather(comm, sizes, 0);
    auto values          = Utilities::MPI::gather(comm, numbers, 0);
    archive(cells, counts, values);
  }



  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::load(Archive &archive, const MovingMesh<dim> &mesh)
  {
    std::vector<std::vector<unsigned int>> cells, counts;
    std::vector<std::vector<Number>>       values;
    archive(cells, counts, values);
    *this = PointTensors();
    if (std::all_of(values.begin(), values.end(), [](const auto &of_rank) {
          return of_rank.empty();
        }))
      return;

    // by cell of the description, where its numbers begin, and how many
    std::vector<std::pair<const Number *, unsigned int>> saved(
      mesh.n_global_cells(), {nullptr, 0});
    bool complete =
      cells.size() == values.size() && counts.size() == values.size();
    for (unsigned int r = 0; complete && r < values.size(); ++r)
      {
        complete          = cells[r].size() == counts[r].size();
        std::size_t first = 0;
        for (unsigned int i = 0; complete && i < cells[r].size(); ++i)
          {
            complete = cells[r][i] < saved.size() &&
                       counts[r][i] <= values[r].size() - first;
            if (complete)
              saved[cells[r][i]] = {values[r].data() + first, counts[r][i]};
            first += counts[r][i];
          }
        for (const Number number : values[r])
          if (!std::isfinite(number))
            throw CheckpointError("it has values that are not finite");
      }
    if (!complete)
      throw CheckpointError("tensors at points are missing");

    *this        = PointTensors(mesh);
    bool fitting = true;
    for (const Cell &cell : mesh.cells())
      if (cell.owned)
        {
          const auto &of_cell = saved[cell.iterator->active_cell_index()];
          if (of_cell.second == begin[cell.index + 1] - begin[cell.index])
            std::copy_n(of_cell.first,
                        of_cell.second,
                        numbers.begin() + begin[cell.index]);
          else
            fitting = false;
        }
    if (Utilities::MPI::min(fitting ? 1 : 0, mesh.communicator()) == 0)
      throw CheckpointError("a cell of its mesh has another number of points");
  }



  template class PointTensors<2, float>;
  template class PointTensors<3, float>;
  template class PointTensors<2, double>;
  template class PointTensors<3, double>;
} // namespace Catena

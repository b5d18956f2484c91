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



  /// As how many numbers each cell of the description has, and all of them.
  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::save(Archive               &archive,
                                  const MovingMesh<dim> &mesh) const
  {
    using CellNumbers = std::pair<unsigned int, std::vector<Number>>;
    std::vector<CellNumbers> mine;
    if (!empty())
      for (const Cell &cell : mesh.cells())
        if (cell.owned)
          mine.emplace_back(
            cell.iterator->active_cell_index(),
            std::vector<Number>(numbers.begin() + begin[cell.index],
                                numbers.begin() + begin[cell.index + 1]));

    std::vector<std::vector<Number>> cells;
    for (auto &of_rank :
         Utilities::MPI::gather(mesh.communicator(), std::move(mine), 0))
      for (CellNumbers &cell : of_rank)
        {
          if (cells.empty())
            cells.resize(mesh.n_global_cells());
          cells[cell.first] = std::move(cell.second);
        }

    std::vector<unsigned int> counts;
    std::vector<Number>       ordered;
    for (const std::vector<Number> &cell : cells)
      {
        counts.push_back(cell.size());
        ordered.insert(ordered.end(), cell.begin(), cell.end());
      }
    archive(counts, ordered);
  }



  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::load(Archive &archive, const MovingMesh<dim> &mesh)
  {
    std::vector<unsigned int> counts;
    std::vector<Number>       ordered;
    archive(counts, ordered);
    *this = PointTensors();
    if (counts.empty())
      return;

    if (counts.size() != mesh.n_global_cells())
      throw CheckpointError(
        "it has tensors at the points of " + std::to_string(counts.size()) +
        " cells in a mesh of " + std::to_string(mesh.n_global_cells()));
    std::vector<std::size_t> first(1, 0);
    for (const unsigned int count : counts)
      first.push_back(first.back() + count);
    if (first.back() != ordered.size())
      throw CheckpointError("tensors at points are missing");
    for (const Number number : ordered)
      if (!std::isfinite(number))
        throw CheckpointError("it has values that are not finite");

    *this        = PointTensors(mesh);
    bool fitting = true;
    for (const Cell &cell : mesh.cells())
      if (cell.owned)
        {
          const unsigned int c = cell.iterator->active_cell_index();
          if (counts[c] == begin[cell.index + 1] - begin[cell.index])
            std::copy(ordered.begin() + first[c],
                      ordered.begin() + first[c + 1],
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

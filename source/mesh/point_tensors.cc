#include <catena/base/on_root.h>
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
  } // namespace



  template <int dim, typename Number>
  PointTensors<dim, Number>::PointTensors(const MovingMesh<dim> &mesh)
  {
    begin.reserve(mesh.cells().size() + 1);
    begin.push_back(0);
    for (const Cell &cell : mesh.cells())
      begin.push_back(
        begin.back() +
        (cell.owned ? n_points<dim>(cell.curved) * n_components : 0));
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
        pack.n_points =
          std::min<unsigned int>(pack_size, result.size() - pack.first);
        const Tensors tensors = get(cell, pack);
        for (unsigned int k = 0; k < pack.n_points; ++k)
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



  /// Of the cells of one rank after the other their numbers in the description,
  /// how many numbers each has, and these.
  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::save(Archive &archive, const MovingMesh<dim> &mesh)
  {
    std::vector<unsigned int> owned, sizes;
    if (!empty())
      for (const Cell &cell : mesh.cells())
        if (cell.owned)
          {
            owned.push_back(cell.iterator->active_cell_index());
            sizes.push_back(begin[cell.index + 1] - begin[cell.index]);
          }
    std::vector<unsigned int> cells  = on_root(owned, mesh.communicator()),
                              counts = on_root(sizes, mesh.communicator());
    archive(cells, counts);
    if (Utilities::MPI::n_mpi_processes(mesh.communicator()) == 1)
      archive(numbers); // large: without a copy
    else
      {
        std::vector<Number> values = on_root(numbers, mesh.communicator());
        archive(values);
      }
  }



  template <int dim, typename Number>
  void
  PointTensors<dim, Number>::load(Archive &archive, const MovingMesh<dim> &mesh)
  {
    std::vector<unsigned int> cells, counts;
    std::vector<Number>       values;
    archive(cells, counts, values);
    *this = PointTensors();
    if (cells.empty() && values.empty())
      return;

    if (cells.size() != mesh.n_global_cells() || counts.size() != cells.size())
      throw CheckpointError(
        "it has tensors at the points of " + std::to_string(cells.size()) +
        " cells in a mesh of " + std::to_string(mesh.n_global_cells()));
    // by cell of the description, where its numbers begin, and how many
    std::vector<std::pair<std::size_t, unsigned int>> saved(cells.size(),
                                                            {0, 0});
    std::size_t                                       first = 0;
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        if (cells[i] >= saved.size() || counts[i] > values.size() - first)
          throw CheckpointError("tensors at points are missing");
        saved[cells[i]] = {first, counts[i]};
        first += counts[i];
      }
    if (first != values.size())
      throw CheckpointError("it has more tensors at points than are known of");
    for (const Number value : values)
      if (!std::isfinite(value))
        throw CheckpointError("it has values that are not finite");

    *this        = PointTensors(mesh);
    bool fitting = true;
    for (const Cell &cell : mesh.cells())
      if (cell.owned)
        {
          const auto &of_cell = saved[cell.iterator->active_cell_index()];
          if (of_cell.second == begin[cell.index + 1] - begin[cell.index])
            std::copy_n(values.begin() + of_cell.first,
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

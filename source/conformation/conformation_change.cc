#include <catena/conformation/conformation_change.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/quality.h>
#include <catena/rheology/spectral.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  ConformationChange
  conformation_change(const MovingMesh<dim>         &mesh,
                      const std::vector<VectorType> &s,
                      const std::vector<VectorType> &s_hat)
  {
    // at each vertex first: it belongs to many cells
    const unsigned int  n = mesh.scalar_dofs().n_dofs();
    std::vector<double> stretch(n, 0.), change(n, 0.);
    for (const auto i : mesh.relevant_scalars())
      {
        const auto tensor     = vertex_tensor<dim>(i, s);
        const auto difference = tensor - vertex_tensor<dim>(i, s_hat);
        change[i]             = difference * difference;
        // not a number would hide behind comparisons
        if (!std::isfinite(change[i]))
          change[i] = std::numeric_limits<double>::infinity();
        else
          for (const double value : spectral_decomposition<dim>(tensor).values)
            stretch[i] += std::expm1(value);
      }
    const double largest = *std::max_element(change.begin(), change.end());

    double weighted = 0., energy = 0.;
    for (const auto &cell : mesh.cells())
      if (cell.owned)
        {
          const auto positions = mesh.cell_positions(cell, mesh.positions());
          std::array<Point<dim>, n_linear_nodes(dim)> corners;
          std::copy_n(positions.begin(), corners.size(), corners.begin());
          const double volume = simplex_volume<dim>(corners);
          for (const unsigned int i : cell.vertices)
            {
              weighted += volume * stretch[i] * change[i];
              energy += volume * stretch[i];
            }
        }
    weighted = Utilities::MPI::sum(weighted, mesh.communicator());
    energy   = Utilities::MPI::sum(energy, mesh.communicator());
    ConformationChange result;
    result.largest =
      std::sqrt(Utilities::MPI::max(largest, mesh.communicator()));
    result.mean = energy > 0. ? std::sqrt(weighted / energy) : 0.;
    return result;
  }



  template ConformationChange
  conformation_change<2>(const MovingMesh<2> &,
                         const std::vector<VectorType> &,
                         const std::vector<VectorType> &);
  template ConformationChange
  conformation_change<3>(const MovingMesh<3> &,
                         const std::vector<VectorType> &,
                         const std::vector<VectorType> &);
} // namespace Catena

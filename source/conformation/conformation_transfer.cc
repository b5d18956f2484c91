#include <catena/conformation/conformation_transfer.h>
#include <catena/conformation/entropy_projection.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/exponential.h>
#include <catena/rheology/spectral.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// c_p - exp(s), with c_p at the points of all cells.
    template <int dim>
    PointTensors<dim>
    unresolved_part(const std::vector<SymmetricTensor<2, dim>> &conformation,
                    const std::vector<VectorType> &log_conformation,
                    const MovingMesh<dim>         &mesh,
                    const VectorType              &positions)
    {
      PointTensors<dim> result(mesh);
      CellValues<dim>   values;
      auto              next = conformation.begin();
      for (const auto &cell : mesh.cells())
        {
          values.reinit(mesh.cell_positions(cell, positions), cell.curved);
          const auto s = vertex_tensors<dim>(cell, log_conformation);
          for (const auto &pack : values.packs())
            {
              SymmetricTensor<2, dim, Pack> c_p;
              for (unsigned int k = 0; k < pack.n_points; ++k)
                set_lane(c_p, k, *next++);
              if (cell.owned)
                result.set(cell,
                           pack,
                           c_p - exponential(interpolate<dim>(pack, s)));
            }
        }
      return result;
    }
  } // namespace



  template <int dim>
  void
  transfer_conformation(const FieldTransfer<dim> &transfer,
                        const MovingMesh<dim>    &mesh,
                        const VectorType         &positions,
                        std::vector<VectorType>  &log_conformation,
                        PointTensors<dim>        &unresolved)
  {
    auto conformation = transfer.conserved_at_points(
      log_conformation,
      [](const SymmetricTensor<2, dim> &s) {
        return exponential<dim>(spectral_decomposition<dim>(s));
      },
      unresolved);
    const auto guess = transfer.tensor(log_conformation);
    log_conformation = EntropyProjection<dim>(mesh, positions)
                         .project(conformation.of_field, guess);
    for (unsigned int q = 0; q < conformation.of_field.size(); ++q)
      conformation.of_field[q] += conformation.of_points[q];
    unresolved =
      unresolved_part(conformation.of_field, log_conformation, mesh, positions);
  }



  template void
  transfer_conformation<2>(const FieldTransfer<2> &,
                           const MovingMesh<2> &,
                           const VectorType &,
                           std::vector<VectorType> &,
                           PointTensors<2> &);
  template void
  transfer_conformation<3>(const FieldTransfer<3> &,
                           const MovingMesh<3> &,
                           const VectorType &,
                           std::vector<VectorType> &,
                           PointTensors<3> &);
} // namespace Catena

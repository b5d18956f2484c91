#include <catena/conformation/conformation_transfer.h>
#include <catena/conformation/entropy_projection.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/exponential.h>
#include <catena/rheology/spectral.h>

#include <algorithm>

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



    /**
     * Raise the eigenvalues of s at the vertices that are far below those of
     * the field at hand: where it is steep the projection swings, and what is
     * compressed by it would relax at the rate exp(-s)/lambda.
     */
    template <int dim>
    void
    bound_from_below(std::vector<VectorType>       &log_conformation,
                     const std::vector<VectorType> &field,
                     const MovingMesh<dim>         &mesh)
    {
      constexpr double margin   = 0.5;
      const auto       spectrum = [](const std::vector<VectorType> &s,
                               const unsigned int             vertex) {
        return spectral_decomposition<dim>(vertex_tensor<dim>(vertex, s));
      };
      for (const auto vertex : mesh.owned_scalars())
        {
          const auto   wanted  = spectrum(field, vertex).values;
          const auto   present = spectrum(log_conformation, vertex);
          const double smallest =
            *std::min_element(wanted.begin(), wanted.end()) - margin;
          Tensor<2, dim> raised;
          bool           is_raised = false;
          for (unsigned int i = 0; i < dim; ++i)
            {
              is_raised |= present.values[i] < smallest;
              raised[i][i] = std::max(present.values[i], smallest);
            }
          if (!is_raised)
            continue;
          const SymmetricTensor<2, dim> s = from_frame(raised, present.vectors);
          for (unsigned int k = 0; k < log_conformation.size(); ++k)
            log_conformation[k](vertex) = s.access_raw_entry(k);
        }
      for (VectorType &component : log_conformation)
        component.update_ghost_values();
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
    bound_from_below(log_conformation, guess, mesh);
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

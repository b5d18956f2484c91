// Tensors at quadrature points come through a checkpoint as they were, and on
// another mesh, also over the cut of a rotationally symmetric box, what is
// linear in space is what it was.

#include <catena/mesh/cell_fields.h>
#include <catena/mesh/field_archive.h>
#include <catena/mesh/field_transfer.h>

#include "../tests.h"

#include "scenes.h"

using namespace dealii;
using namespace Catena;
using namespace Catena::Tests;

/// Linear, and the same after half a turn about z.
SymmetricTensor<2, 3>
exact(const Point<3> &x)
{
  SymmetricTensor<2, 3> tensor;
  tensor[0][0] = 1. + x[2];
  tensor[1][1] = 2. - x[2];
  tensor[0][1] = 0.5;
  tensor[0][2] = x[0] + x[1];
  tensor[1][2] = x[1];
  return tensor;
}



/// The function of the points of each cell and their number among all points.
template <typename Function>
void
for_each_pack(const MovingMesh<3> &mesh, const Function &function)
{
  CellValues<3> values;
  std::size_t   first = 0;
  for (const auto &cell : mesh.cells())
    {
      const auto nodes = mesh.cell_positions(cell, mesh.positions());
      values.reinit(nodes, cell.curved);
      for (const auto &pack : values.packs())
        {
          SymmetricTensor<2, 3, Pack> tensors;
          for (unsigned int k = 0; k < pack.n_points; ++k)
            set_lane(tensors,
                     k,
                     exact(
                       position_at<3>(values.points()[pack.first + k], nodes)));
          function(cell, pack, tensors, first + pack.first);
        }
      first += values.points().size();
    }
}



PointTensors<3>
exact_tensors(const MovingMesh<3> &mesh)
{
  PointTensors<3> result(mesh);
  for_each_pack(
    mesh, [&](const auto &cell, const auto &pack, const auto &tensors, auto) {
      if (cell.owned)
        result.set(cell, pack, tensors);
    });
  return result;
}



void
check_checkpoint(Claims &claims, const MovingMesh<3> &mesh)
{
  PointTensors<3> tensors = exact_tensors(mesh), loaded, none;
  Archive         saved;
  FieldArchive<3>(saved, mesh).points(tensors);
  FieldArchive<3>(saved, mesh).points(none);
  Archive archive(Utilities::MPI::broadcast(MPI_COMM_WORLD, saved.bytes()));
  FieldArchive<3>(archive, mesh).points(loaded);
  none = tensors;
  FieldArchive<3>(archive, mesh).points(none);
  archive.finish();

  double difference = 0.;
  for_each_pack(mesh,
                [&](const auto &cell, const auto &pack, const auto &, auto) {
                  if (cell.owned)
                    for (unsigned int k = 0; k < pack.n_points; ++k)
                      difference =
                        std::max(difference,
                                 (lane<3>(SymmetricTensor<2, 3, Pack>(
                                            tensors.get(cell, pack) -
                                            loaded.get(cell, pack)),
                                          k))
                                   .norm());
                });
  claims.at_most("loaded as saved",
                 Utilities::MPI::max(difference, MPI_COMM_WORLD),
                 0.);
  claims.holds("none is none", none.empty());
}



void
check_transfer(Claims              &claims,
               const MovingMesh<3> &source,
               const MovingMesh<3> &target)
{
  const FieldTransfer<3> transfer(source,
                                  source.positions(),
                                  target,
                                  target.positions());
  const auto             transferred = transfer
                             .conserved_at_points(
                               source.tensor_field(),
                               [](const SymmetricTensor<2, 3> &s) { return s; },
                               exact_tensors(source))
                             .of_points;

  double largest = 0., squares = 0., volume = 0.;
  for_each_pack(
    target,
    [&](const auto &, const auto &pack, const auto &tensors, auto first) {
      for (unsigned int k = 0; k < pack.n_points; ++k)
        {
          const double error =
            (lane<3>(tensors, k) - transferred[first + k]).norm();
          largest = std::max(largest, error);
          squares += pack.JxW[k] * error * error;
          volume += pack.JxW[k];
        }
    });
  claims.at_most("all points, curved cells included",
                 Utilities::MPI::max(largest, MPI_COMM_WORLD),
                 0.05);
  claims.at_most("in the mean",
                 std::sqrt(Utilities::MPI::sum(squares, MPI_COMM_WORLD) /
                           Utilities::MPI::sum(volume, MPI_COMM_WORLD)),
                 1e-3);
}



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const auto make = [](const Cut cut, const unsigned int on_equator) {
      MeshParameters parameters;
      parameters.elements_on_equator = on_equator;
      parameters.elements_across_gap = 1;
      const Scene<3> scene           = three_particles<3>(2.3, 10., cut);
      return std::make_unique<MovingMesh<3>>(
        MPI_COMM_WORLD, scene, generate_mesh<3>(scene, parameters));
    };
    const auto source = make(Cut::x_plane, 16), target = make(Cut::y_plane, 20);
    check_checkpoint(claims, *source);
    check_transfer(claims, *source, *target);
  });
}

// The smooth rate of strain of a velocity that is quadratic in space is linear:
// the projection has it, up to what the curved elements miss, also where the
// box is periodic.

#include <catena/conformation/strain_rate_projection.h>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "fields.h"

using namespace dealii;
using namespace Catena;
using namespace Catena::Tests;



int
main(int argc, char **argv)
{
  return run(argc, argv, [](Claims &claims) {
    const Scene<3> scene = two_particles<3>(Symmetry::none, 2.3);
    MeshParameters parameters;
    parameters.elements_on_equator = 24;
    parameters.elements_across_gap = 1;
    const MovingMesh<3> mesh(MPI_COMM_WORLD,
                             scene,
                             generate_mesh<3>(scene, parameters));

    // u = (y^2, 0, 0)
    VectorType velocity = mesh.vector_field();
    for (const auto node : mesh.owned_nodes())
      velocity(3 * node) = std::pow(mesh.positions()(3 * node + 1), 2);
    velocity.update_ghost_values();
    const auto rate = StrainRateProjection<3>(mesh).project(velocity);

    double largest = 0., sum = 0.;
    for (const auto i : mesh.owned_scalars())
      {
        const auto            node = mesh.node_of_vertex(i);
        SymmetricTensor<2, 3> difference;
        for (unsigned int k = 0; k < rate.size(); ++k)
          difference.access_raw_entry(k) = rate[k](i);
        difference[0][1] -= mesh.positions()(3 * node + 1);
        largest = std::max(largest, difference.norm());
        sum += difference.norm();
      }
    largest = Utilities::MPI::max(largest, MPI_COMM_WORLD);
    const double mean =
      Utilities::MPI::sum(sum, MPI_COMM_WORLD) / mesh.scalar_dofs().n_dofs();
    claims.at_most("largest error at a vertex", largest, 3e-2);
    claims.at_most("mean error", mean, 2e-3);
  });
}

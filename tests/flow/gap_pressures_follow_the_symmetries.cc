// The pressures of a narrow gap: as many as there are forms with the symmetries
// of the scene, orthonormal in the mass matrix, and none for a wide gap; of
// many gaps there are some.

#include <catena/flow/flow_assembly.h>
#include <catena/flow/gap_pressures.h>
#include <catena/flow/velocity_constraints.h>

#include <cmath>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "../print.h"
#include "stokes_problem.h"

using namespace Catena;

namespace
{
  template <int dim>
  void
  test(Tests::Claims     &claims,
       const std::string &name,
       const Scene<dim>  &scene,
       const unsigned int n_wanted)
  {
    const Tests::StokesProblem<dim> problem(scene, Tests::resolution(20, 2));
    const auto                      couplings =
      node_couplings<dim>(problem.mesh,
                          velocity_constraints<dim>(problem.mesh,
                                                    problem.bodies,
                                                    problem.configuration,
                                                    false));
    FlowSystem<dim>             system(problem.mesh, problem.bodies, couplings);
    PreconditionerMatrices<dim> matrices(problem.mesh, couplings);
    assemble_flow<dim>(NewtonianStress<dim>(),
                       scene.imposed_gradient(),
                       system,
                       &matrices);

    const GapPressures<dim> gap_pressures(problem.mesh,
                                          problem.configuration,
                                          matrices.pressure_mass);
    claims.holds(name + ": as many as there are forms",
                 gap_pressures.size() == n_wanted);
    Tests::print(name, ": ", gap_pressures.size());

    FastVectorType pressure, functional;
    pressure.reinit(system.pressure_rhs);
    functional.reinit(pressure);
    double error = 0., left = 0.;
    for (unsigned int k = 0; k < gap_pressures.size(); ++k)
      {
        pressure = 0.f;
        gap_pressures.add_to(pressure, k, 1.);
        matrices.pressure_mass.vmult(functional, pressure);
        const std::vector<double> products = gap_pressures.products(functional);
        for (unsigned int l = 0; l < products.size(); ++l)
          error = std::max(error, std::abs(products[l] - (l == k ? 1. : 0.)));
        gap_pressures.remove(functional, products);
        for (const double product : gap_pressures.products(functional))
          left = std::max(left, std::abs(product));
      }
    claims.at_most(name + ": orthonormal", error, 1e-4);
    claims.at_most(name + ": nothing left", left, 1e-4);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    using namespace Tests;
    // q^2, q^4, and x_t q^3 in the directions that symmetry allows
    test<3>(claims, "all of the box", two_particles<3>(Symmetry::none), 4);
    test<3>(claims, "half, mirrored", two_particles<3>(Symmetry::half), 3);
    test<3>(claims, "three in a quarter", three_particles<3>(), 3);
    test<3>(claims,
            "three in a quarter cut at y",
            three_particles<3>(2.04, 10., Cut::y_plane),
            3);
    // the gap is its own image, and x_t changes its sign
    Scene<3> pair  = two_particles<3>(Symmetry::quarter);
    pair.particles = {pair.particles[0]};
    test<3>(claims, "two in a quarter", pair, 2);
    test<3>(claims, "very narrow", three_particles<3>(2.02), 5);
    test<3>(claims, "wide", three_particles<3>(2.3), 0);
    test<2>(claims, "discs", three_particles<2>(), 3);

    // 24 gaps with three forms each: 32 are reached with the eleventh
    Scene<2> grid;
    grid.symmetry = Symmetry::none;
    for (unsigned int i = 0; i < 16; ++i)
      grid.particles.push_back({{2.1 * (i % 4) - 3.15, 2.1 * (i / 4) - 3.15}});
    test<2>(claims, "many discs", grid, 33);
  });
}

// Two spheres at a gap of 0.005 diameters in a Newtonian fluid, with three
// elements across the gap: elements four times longer along the gap than across
// it give the exact motion and force as well as others, and are less than half
// as many.

#include "spheres_in_a_line.h"

using namespace Catena;

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const Tests::Line line{2, 2.01, 10.};
    MeshParameters    mesh = Tests::resolution(32, 3);
    double            change;

    Tests::ComputedMotion   isotropic(line, mesh);
    const Tests::Quantities without = isotropic.solve(change);
    mesh.gap_stretch                = 4.;
    Tests::ComputedMotion   stretched(line, mesh);
    const Tests::Quantities with = stretched.solve(change);

    claims.at_most("elements against those of an isotropic mesh",
                   static_cast<double>(stretched.n_cells()) /
                     isotropic.n_cells(),
                   0.5);
    for (const auto &exact : Tests::exact_motion(line))
      {
        const auto error = [&](const Tests::Quantities &computed) {
          return std::abs(computed.at(exact.first) / exact.second - 1.);
        };
        claims.at_most("relative error of " + exact.first, error(with), 3e-3);
        claims.at_most(exact.first + " against that of an isotropic mesh",
                       error(with),
                       error(without) + 2e-4);
      }
  });
}

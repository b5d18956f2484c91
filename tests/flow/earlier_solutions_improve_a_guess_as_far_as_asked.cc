// A guess becomes the combination with earlier solutions whose residual is the
// smallest, of no more of them than it needs; a good one stays as it is.

#include <catena/flow/earlier_solutions.h>
#include <catena/flow/flow_assembly.h>
#include <catena/flow/velocity_constraints.h>

#include <random>

#include "../tests.h"

#include "../mesh/scenes.h"
#include "stokes_problem.h"

using namespace Catena;

namespace
{
  void
  test(Tests::Claims &claims)
  {
    const auto                    scene = Tests::three_particles<2>();
    const Tests::StokesProblem<2> problem(scene, Tests::resolution(16, 1));
    const auto                    couplings =
      node_couplings<2>(problem.mesh,
                        velocity_constraints<2>(problem.mesh,
                                                problem.bodies,
                                                problem.configuration,
                                                false));
    FlowSystem<2> flow(problem.mesh, problem.bodies, couplings);
    assemble_flow<2>(problem.stress, scene.imposed_gradient(), flow, nullptr);
    const ContactBlocks           no_contacts;
    const FlowOperator<2, double> system{flow, no_contacts};

    std::mt19937                     generator(1);
    std::normal_distribution<double> normal;
    const auto                       any_vector = [&]() {
      BlockVectorType x(3);
      x.block(0).reinit(flow.velocity_rhs);
      x.block(1).reinit(flow.pressure_rhs);
      x.block(2).reinit(
        VectorType(dealii::complete_index_set(flow.n_rigid()), MPI_COMM_SELF));
      x.collect_sizes();
      for (unsigned int b = 0; b < x.n_blocks(); ++b)
        for (double &value : x.block(b))
          value = normal(generator);
      return x;
    };
    const auto residual = [&](const BlockVectorType &x,
                              const BlockVectorType &rhs) {
      BlockVectorType r(rhs);
      system.vmult(r, x);
      r -= rhs;
      return r.l2_norm();
    };

    // the solution is a combination of the guess and two earlier ones
    EarlierSolutions<2>          earlier;
    std::vector<BlockVectorType> solutions;
    for (unsigned int k = 0; k < 3; ++k)
      {
        solutions.push_back(any_vector());
        earlier.begin_instant();
        earlier.remember(solutions.back());
      }
    const BlockVectorType guess = any_vector();
    BlockVectorType       exact(guess), rhs(guess);
    exact *= 0.9;
    exact.add(0.4, solutions[2], -0.3, solutions[1]);
    system.vmult(rhs, exact);
    const double first = residual(guess, rhs);

    BlockVectorType x(guess);
    earlier.improve(system, rhs, 0., x);
    claims.at_most("the combination is found", residual(x, rhs) / first, 1e-12);

    x = guess;
    earlier.improve(system, rhs, 1.01 * first, x);
    x -= guess;
    claims.at_most("a good guess stays as it is", x.l2_norm(), 0.);

    // with the newest alone, by hand
    BlockVectorType direction(solutions[2]), image(guess), start(rhs);
    direction -= guess;
    system.vmult(image, direction);
    system.vmult(start, guess);
    start.sadd(-1., 1., rhs);
    x = guess;
    x.add((start * image) / (image * image), direction);
    const double with_newest = residual(x, rhs);

    BlockVectorType y(guess);
    earlier.improve(system, rhs, 1.01 * with_newest, y);
    y -= x;
    claims.at_most("no more solutions than it needs take part",
                   y.l2_norm() / x.l2_norm(),
                   1e-12);
    claims.holds("the newest alone does not do for more",
                 with_newest > 0.1 * first);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

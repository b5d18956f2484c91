#include <catena/base/replicated.h>
#include <catena/flow/earlier_solutions.h>

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_solutions = 4;

    /**
     * Image of a direction, without those of the others, against the residual:
     * below that it is noise, and the step would be large.
     */
    constexpr double smallest_share = 1e-3;



    /// dst += factor (x - x_0), in the blocks that both have.
    void
    add_difference(BlockVectorType       &dst,
                   const double           factor,
                   const BlockVectorType &x,
                   const BlockVectorType &x_0)
    {
      for (unsigned int b = 0; b < std::min(x.n_blocks(), x_0.n_blocks()); ++b)
        if (x.block(b).size() == x_0.block(b).size())
          dst.block(b).add(factor, x.block(b), -factor, x_0.block(b));
    }
  } // namespace



  template <int dim>
  void
  EarlierSolutions<dim>::clear()
  {
    solutions.clear();
    newest_is_of_this_instant = false;
  }



  template <int dim>
  void
  EarlierSolutions<dim>::begin_instant()
  {
    newest_is_of_this_instant = false;
  }



  template <int dim>
  void
  EarlierSolutions<dim>::remember(const BlockVectorType &solution)
  {
    if (newest_is_of_this_instant)
      solutions.pop_front();
    if (solutions.size() == n_solutions)
      solutions.pop_back();
    solutions.push_front(solution);
    newest_is_of_this_instant = true;
  }



  template <int dim>
  template <typename Number>
  void
  EarlierSolutions<dim>::improve(const FlowOperator<dim, Number> &system,
                                 const BlockVectorType           &rhs,
                                 const double                     wanted,
                                 BlockVectorType                 &guess) const
  {
    if (solutions.empty())
      return;
    BlockVectorType residual(rhs);
    system.vmult(residual, guess);
    residual.sadd(-1., 1., rhs);
    double       norm           = residual.l2_norm();
    const double smallest_image = smallest_share * norm;

    // directions whose images under A are orthonormal, as sums over x_i - x_0
    std::vector<Vector<double>>  directions;
    std::vector<BlockVectorType> images;
    Vector<double>               factors(solutions.size());
    for (unsigned int n = 0; n < solutions.size() && norm > wanted; ++n)
      {
        BlockVectorType difference(guess), image(guess);
        difference = 0.;
        add_difference(difference, 1., solutions[n], guess);
        system.vmult(image, difference);
        Vector<double> direction(solutions.size());
        direction(n) = 1.;
        for (unsigned int i = 0; i < images.size(); ++i)
          {
            const double projection = image * images[i];
            image.add(-projection, images[i]);
            direction.add(-projection, directions[i]);
          }
        const double remainder = image.l2_norm();
        if (!(remainder > smallest_image))
          continue;
        image *= 1. / remainder;
        direction *= 1. / remainder;

        const double alpha = residual * image;
        norm = std::sqrt(residual.add_and_dot(-alpha, image, residual));
        factors.add(alpha, direction);
        directions.push_back(std::move(direction));
        images.push_back(std::move(image));
      }

    images.clear();
    const BlockVectorType first_guess = guess;
    for (unsigned int n = 0; n < solutions.size(); ++n)
      if (factors(n) != 0.)
        add_difference(guess, factors(n), solutions[n], first_guess);
  }



  template <int dim>
  void
  EarlierSolutions<dim>::archive(FieldArchive<dim> &archive,
                                 const MakeVector  &make_vector)
  {
    std::uint32_t n = solutions.size();
    archive(n, newest_is_of_this_instant);
    if (n > n_solutions)
      throw CheckpointError("it has " + std::to_string(n) +
                            " earlier solutions");
    solutions.resize(n);
    for (BlockVectorType &solution : solutions)
      {
        std::vector<double> motions, forces;
        if (solution.n_blocks() > 2)
          motions = replicate(solution.block(2));
        if (solution.n_blocks() > 3)
          forces = replicate(solution.block(3));
        archive(motions, forces);
        if (archive.is_loading())
          {
            const BlockVectorType layout = make_vector(0);
            const std::size_t     n_motions =
              layout.n_blocks() > 2 ? layout.block(2).size() : 0;
            if (motions.size() != n_motions ||
                (n_motions == 0 && !forces.empty()))
              throw CheckpointError(
                "it has a solution with " + std::to_string(motions.size()) +
                " motions of particles and " + std::to_string(forces.size()) +
                " contact forces");
            solution = make_vector(forces.size());
            if (solution.n_blocks() > 2)
              set_replicated(solution.block(2), motions);
            if (solution.n_blocks() > 3)
              set_replicated(solution.block(3), forces);
          }
        archive.vector(solution.block(0));
        archive.scalar(solution.block(1));
      }
  }



  template class EarlierSolutions<2>;
  template class EarlierSolutions<3>;
  template void
  EarlierSolutions<2>::improve(const FlowOperator<2, double> &,
                               const BlockVectorType &,
                               const double,
                               BlockVectorType &) const;
  template void
  EarlierSolutions<3>::improve(const FlowOperator<3, double> &,
                               const BlockVectorType &,
                               const double,
                               BlockVectorType &) const;
  template void
  EarlierSolutions<2>::improve(const FlowOperator<2, float> &,
                               const BlockVectorType &,
                               const double,
                               BlockVectorType &) const;
  template void
  EarlierSolutions<3>::improve(const FlowOperator<3, float> &,
                               const BlockVectorType &,
                               const double,
                               BlockVectorType &) const;
} // namespace Catena

#ifndef catena_flow_earlier_solutions_h
#define catena_flow_earlier_solutions_h

#include <catena/base/types.h>
#include <catena/flow/flow_operator.h>
#include <catena/mesh/field_archive.h>

#include <deque>
#include <functional>

namespace Catena
{
  /**
   * Solutions x_1, x_2, ... of the instants before, by which a first guess x_0
   * is improved (Fischer, Comput. Methods Appl. Mech. Engrg. 163, 1998): of all
   *
   *   x = x_0 + sum_i alpha_i (x_i - x_0)
   *
   * it becomes the one with the smallest residual |b - A x|, where i runs from
   * the newest solution to the one with which that is small enough. With all of
   * them it is at least as good as every extrapolation in time through these
   * solutions, but for directions that would change the residual by less than a
   * thousandth of it. Each costs one product with A. Contact forces take part
   * where there are as many contacts as there were.
   */
  template <int dim>
  class EarlierSolutions
  {
  public:
    /// Forget all.
    void
    clear();

    /// What is remembered from now on belongs to another instant.
    void
    begin_instant();

    /// The solution of this instant, in place of what it had before.
    void
    remember(const BlockVectorType &solution);

    /**
     * Improve @p guess until its residual is at most @p wanted or no solution
     * is left.
     */
    template <typename Number>
    void
    improve(const FlowOperator<dim, Number> &system,
            const BlockVectorType           &rhs,
            const double                     wanted,
            BlockVectorType                 &guess) const;

    /// Makes a vector with the blocks of a solution with that many contacts.
    using MakeVector = std::function<BlockVectorType(const unsigned int)>;

    /// Save or load them.
    void
    archive(FieldArchive<dim> &archive, const MakeVector &make_vector);

  private:
    /// newest first; velocity, pressure, rigid-body motions, contact forces
    std::deque<BlockVectorType> solutions;
    bool                        newest_is_of_this_instant = false;
  };
} // namespace Catena

#endif

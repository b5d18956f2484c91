#ifndef catena_flow_prolongation_h
#define catena_flow_prolongation_h

#include <catena/flow/node_matrix.h>

namespace Catena
{
  /**
   * A sparse matrix P from the nodes of a coarser level to those of a finer
   * one, the same for all fields, with its rows distributed over the ranks.
   * Unlike a NodeMatrix it has few entries in a row.
   */
  class Prolongation
  {
  public:
    Prolongation() = default;

    /**
     * @param rows the rows of this rank
     * @param nodes the nodes of the coarser level; those of other ranks in
     * @p rows are among its ghosts
     */
    Prolongation(const SparseRows                          &rows,
                 const dealii::Utilities::MPI::Partitioner &nodes);

    /// fine += P coarse; ghosts of @p coarse are needed.
    void
    add_product(Lanes *fine, const Lanes *coarse) const;

    /// coarse += P^T fine, where the sums of ghosts are left to be compressed.
    void
    add_transposed_product(Lanes *coarse, const Lanes *fine) const;

  private:
    /// with local numbers of columns
    SparseRows rows;
  };
} // namespace Catena

#endif

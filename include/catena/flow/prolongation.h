#ifndef catena_flow_prolongation_h
#define catena_flow_prolongation_h

#include <catena/flow/node_matrix.h>

#include <vector>

namespace Catena
{
  /**
   * A sparse matrix P from the nodes of a coarser level to those of a finer
   * one, with its rows distributed over the ranks. Unlike a NodeMatrix it has
   * few entries in a row. Rows that are not the same for all fields are kept
   * field by field.
   */
  class Prolongation
  {
  public:
    /// The rows of this rank for some of the fields.
    struct FieldRows
    {
      FieldMask         fields;
      const SparseRows *rows;
    };

    Prolongation() = default;

    /**
     * @param rows for each field at most one
     * @param nodes the nodes of the coarser level; those of other ranks in
     * @p rows are among its ghosts
     */
    Prolongation(const std::vector<FieldRows>              &rows,
                 const dealii::Utilities::MPI::Partitioner &nodes);

    /// fine += P coarse; ghosts of @p coarse are needed.
    void
    add_product(Lanes *fine, const Lanes *coarse) const;

    /// coarse += P^T fine, where the sums of ghosts are left to be compressed.
    void
    add_transposed_product(Lanes *coarse, const Lanes *fine) const;

  private:
    /// The rows with the same number of entries, lest each row's end be
    /// guessed by the processor; columns by local numbers.
    struct RowsOfLength
    {
      std::vector<unsigned int> rows, columns;
      std::vector<float>        values;
    };

    /// An entry of a row that differs between the fields.
    struct FieldEntry
    {
      unsigned int row, column;
      Lanes        value;
    };

    std::vector<RowsOfLength> by_length;
    std::vector<FieldEntry>   single_entries;

    /// Call @p action with a fine node, a coarse one and the entry of both.
    template <typename Action>
    void
    for_each_entry(const Action &action) const;
  };
} // namespace Catena

#endif

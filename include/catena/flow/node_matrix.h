#ifndef catena_flow_node_matrix_h
#define catena_flow_node_matrix_h

#include <catena/base/types.h>
#include <catena/flow/block_pattern.h>

#include <deal.II/base/partitioner.h>

#include <cmath>
#include <memory>
#include <vector>

namespace Catena
{
  /**
   * The values of up to four fields at a node. The compiler keeps them in one
   * register, so that a sweep over a matrix does for all fields what it costs
   * for one.
   */
  using Lanes = float __attribute__((vector_size(16), may_alias));

  constexpr unsigned int n_lanes = 4;

  /// Which of the fields have an unknown at a node, bit by bit.
  using FieldMask = unsigned char;

  /// Up to four fields, interleaved node by node, in single precision.
  using NodeVector = FastVectorType;

  inline Lanes *
  lanes(NodeVector &vector)
  {
    return reinterpret_cast<Lanes *>(vector.begin());
  }

  inline const Lanes *
  lanes(const NodeVector &vector)
  {
    return reinterpret_cast<const Lanes *>(vector.begin());
  }



  /**
   * Consecutive rows of a sparse matrix, the columns in global numbers unless
   * said otherwise.
   */
  struct SparseRows
  {
    std::vector<unsigned int> starts = {0};
    std::vector<unsigned int> columns;
    std::vector<float>        values;

    unsigned int
    size() const
    {
      return starts.size() - 1;
    }

    void
    add(const unsigned int column, const float value)
    {
      columns.push_back(column);
      values.push_back(value);
    }

    void
    end_row()
    {
      starts.push_back(columns.size());
    }

    /// Append row @p i of @p other.
    void
    append(const SparseRows &other, const unsigned int i)
    {
      for (unsigned int k = other.starts[i]; k < other.starts[i + 1]; ++k)
        add(other.columns[k], other.values[k]);
      end_row();
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &starts &columns &values;
    }
  };



  /**
   * A sparse matrix in single precision between the nodes of a level, the
   * same for all fields, with its rows distributed over the ranks. Each row has
   * a multiple of four entries; what it lacks are zeros in its last column.
   */
  class NodeMatrix
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    NodeMatrix() = default;

    /**
     * @param rows the rows of this rank
     * @param nodes the nodes that are the columns; those of other ranks in
     * @p rows are among its ghosts
     */
    NodeMatrix(const SparseRows                  &rows,
               std::shared_ptr<const Partitioner> nodes);

    /// @param entries by pair of nodes in the pattern
    NodeMatrix(const BlockPattern &pattern, const std::vector<float> &entries);

    unsigned int
    n_rows() const
    {
      return rows.size();
    }

    /// The nodes that are the columns.
    const Partitioner &
    column_nodes() const
    {
      return *nodes;
    }

    /// The range of the entries of row @p i.
    std::pair<unsigned int, unsigned int>
    row(const unsigned int i) const
    {
      return {rows.starts[i], rows.starts[i + 1]};
    }

    /// Column of an entry, as a local number.
    unsigned int
    column(const unsigned int entry) const
    {
      return rows.columns[entry];
    }

    float
    value(const unsigned int entry) const
    {
      return rows.values[entry];
    }

    /// The entries that are not zero and whose @p predicate, of row and column,
    /// is true.
    template <typename Predicate>
    NodeMatrix
    select(const Predicate &predicate) const
    {
      NodeMatrix selected;
      selected.nodes = nodes;
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
            if (rows.values[k] != 0.f && predicate(i, rows.columns[k]))
              selected.rows.add(rows.columns[k], rows.values[k]);
          selected.end_row();
        }
      selected.rows.columns.shrink_to_fit();
      selected.rows.values.shrink_to_fit();
      return selected;
    }

    /// Sum of |a_ij| over the columns j.
    float
    sum_of_moduli(const unsigned int i) const
    {
      float sum = 0.f;
      for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
        sum += std::abs(rows.values[k]);
      return sum;
    }

    /// Entry (i,i) of a matrix whose rows and columns are the same nodes.
    float
    diagonal(const unsigned int i) const;

    /// (A src)_i; ghosts of @p src are needed.
    Lanes
    row_times(const unsigned int i, const Lanes *src) const
    {
      const unsigned int       *column = rows.columns.data() + rows.starts[i];
      const float              *value  = rows.values.data() + rows.starts[i];
      const unsigned int *const end = rows.columns.data() + rows.starts[i + 1];
      // four sums, lest each addition wait for the one before
      Lanes sum = {}, sum_1 = {}, sum_2 = {}, sum_3 = {};
      for (; column != end; column += stride, value += stride)
        {
          sum += value[0] * src[column[0]];
          sum_1 += value[1] * src[column[1]];
          sum_2 += value[2] * src[column[2]];
          sum_3 += value[3] * src[column[3]];
        }
      return (sum + sum_1) + (sum_2 + sum_3);
    }

    /// dst += A^T src, of row @p i alone.
    void
    add_transposed_row(const unsigned int i, const Lanes src, Lanes *dst) const
    {
      const unsigned int       *column = rows.columns.data() + rows.starts[i];
      const float              *value  = rows.values.data() + rows.starts[i];
      const unsigned int *const end = rows.columns.data() + rows.starts[i + 1];
      for (; column != end; ++column, ++value)
        dst[*column] += *value * src;
    }

  private:
    static constexpr unsigned int stride = 4;

    SparseRows                         rows;
    std::shared_ptr<const Partitioner> nodes;

    /// Room for rows that have so many entries without the zeros.
    void
    reserve(const std::vector<unsigned int> &starts);

    /// With zeros up to a multiple of the stride.
    void
    end_row();
  };



  /**
   * The nodes of a level: @p n_owned ones of each rank, numbered one rank after
   * the other, and those of other ranks among the columns of @p rows.
   */
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  make_nodes(const unsigned int                     n_owned,
             const std::vector<const SparseRows *> &rows,
             const MPI_Comm                         communicator);

  /// A vector on @p nodes, with ghosts, zero.
  void
  reinit(NodeVector &vector, const dealii::Utilities::MPI::Partitioner &nodes);

  /// The values of a number for each node, ghosts included, from the owned.
  std::vector<unsigned int>
  with_ghosts(const std::vector<unsigned int>           &owned,
              const dealii::Utilities::MPI::Partitioner &nodes);
} // namespace Catena

#endif

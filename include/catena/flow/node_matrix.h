#ifndef catena_flow_node_matrix_h
#define catena_flow_node_matrix_h

#include <catena/base/types.h>

#include <deal.II/base/partitioner.h>

#include <cmath>
#include <memory>
#include <utility>
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

    /// Columns by their local numbers in place of global ones.
    void
    make_local(const dealii::Utilities::MPI::Partitioner &nodes)
    {
      for (unsigned int &column : columns)
        column = nodes.global_to_local(column);
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



  class NodeMatrix;

  /**
   * The rows of this rank of a sparse matrix between the nodes of a level. The
   * entries are somebody else's and stay where they are.
   */
  class NodeRows
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /**
     * @param starts where rows begin, and the end of the last one
     * @param columns, values of the entries, the columns in local numbers
     * @param nodes the nodes that are the columns
     */
    NodeRows(const std::vector<unsigned int>   &starts,
             const unsigned int                *columns,
             const float                       *values,
             std::shared_ptr<const Partitioner> nodes)
      : starts(starts.data())
      , columns(columns)
      , values(values)
      , size(starts.size() - 1)
      , nodes(std::move(nodes))
    {}

    /// @param rows with columns in local numbers
    NodeRows(const SparseRows &rows, std::shared_ptr<const Partitioner> nodes)
      : NodeRows(rows.starts,
                 rows.columns.data(),
                 rows.values.data(),
                 std::move(nodes))
    {}

    unsigned int
    n_rows() const
    {
      return size;
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
      return {starts[i], starts[i + 1]};
    }

    /// Column of an entry, as a local number.
    unsigned int
    column(const unsigned int entry) const
    {
      return columns[entry];
    }

    float
    value(const unsigned int entry) const
    {
      return values[entry];
    }

    /// Entry (i,i) of a matrix whose rows and columns are the same nodes.
    float
    diagonal(const unsigned int i) const;

    /// (A src)_i; ghosts of @p src are needed.
    Lanes
    row_times(const unsigned int i, const Lanes *src) const
    {
      Lanes sum = {};
      for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
        sum += values[k] * src[columns[k]];
      return sum;
    }

    /// The entries that are not zero and whose @p predicate, of row and column,
    /// is true.
    template <typename Predicate>
    NodeMatrix
    select(const Predicate &predicate) const;

  private:
    const unsigned int                *starts, *columns;
    const float                       *values;
    unsigned int                       size;
    std::shared_ptr<const Partitioner> nodes;
  };



  /// The matrix of some of the fields.
  struct FieldMatrix
  {
    FieldMask fields;
    NodeRows  rows;
  };



  /**
   * A sparse matrix in single precision between the nodes of a level, the
   * same for all fields, with its rows distributed over the ranks, to multiply
   * with. Each row has a multiple of four entries; what it lacks are zeros in
   * its last column.
   */
  class NodeMatrix
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    NodeMatrix() = default;

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

    /// Sum of |a_ij| over the columns j.
    float
    sum_of_moduli(const unsigned int i) const
    {
      float sum = 0.f;
      for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
        sum += std::abs(rows.values[k]);
      return sum;
    }

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

    friend class NodeRows;

    /// Room for rows that have so many entries without the zeros.
    void
    reserve(const std::vector<unsigned int> &row_sizes);

    /// With zeros up to a multiple of the stride.
    void
    end_row();
  };



  template <typename Predicate>
  NodeMatrix
  NodeRows::select(const Predicate &predicate) const
  {
    const auto is_selected = [&](const unsigned int i, const unsigned int k) {
      return values[k] != 0.f && predicate(i, columns[k]);
    };
    std::vector<unsigned int> row_sizes(size, 0);
    for (unsigned int i = 0; i < size; ++i)
      for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
        row_sizes[i] += is_selected(i, k) ? 1 : 0;
    NodeMatrix selected;
    selected.nodes = nodes;
    selected.reserve(row_sizes);
    for (unsigned int i = 0; i < size; ++i)
      {
        for (unsigned int k = starts[i]; k < starts[i + 1]; ++k)
          if (is_selected(i, k))
            selected.rows.add(columns[k], values[k]);
        selected.end_row();
      }
    return selected;
  }



  /// The first number of each rank if they number @p n_owned things each, one
  /// rank after the other, and the number of all. Collective.
  std::vector<unsigned int>
  first_of_ranks(const unsigned int n_owned, const MPI_Comm communicator);

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

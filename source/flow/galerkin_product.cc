#include <catena/flow/galerkin_product.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    using Partitioner = Utilities::MPI::Partitioner;

    /**
     * A row of a sparse matrix that is summed up: adding to a column finds it
     * by its number.
     */
    class RowSum
    {
    public:
      explicit RowSum(const unsigned int n_columns)
        : places(n_columns, absent)
      {}

      void
      add(const unsigned int column, const float value)
      {
        unsigned int &place = places[column];
        if (place == absent)
          {
            place = columns.size();
            columns.push_back(column);
            values.push_back(value);
          }
        else
          values[place] += value;
      }

      /// Append the row to @p rows, and start a new one.
      void
      move_to(SparseRows &rows)
      {
        for (unsigned int k = 0; k < columns.size(); ++k)
          {
            rows.add(columns[k], values[k]);
            places[columns[k]] = absent;
          }
        rows.end_row();
        columns.clear();
        values.clear();
      }

    private:
      static constexpr unsigned int absent = numbers::invalid_unsigned_int;

      std::vector<unsigned int> places, columns;
      std::vector<float>        values;
    };



    /// The rows of a matrix's column nodes that other ranks own.
    SparseRows
    ghost_rows(const SparseRows &rows, const Partitioner &nodes)
    {
      std::vector<unsigned int> wanted;
      for (const auto &range : nodes.import_indices())
        for (unsigned int i = range.first; i < range.second; ++i)
          wanted.push_back(i);
      std::map<unsigned int, SparseRows> to_send;
      auto                               next = wanted.begin();
      for (const auto &target : nodes.import_targets())
        for (unsigned int n = 0; n < target.second; ++n)
          to_send[target.first].append(rows, *next++);
      const auto received =
        Utilities::MPI::some_to_some(nodes.get_mpi_communicator(), to_send);

      SparseRows result;
      for (const auto &source : nodes.ghost_targets())
        for (unsigned int i = 0; i < source.second; ++i)
          result.append(received.at(source.first), i);
      return result;
    }



    /// For each column of @p rows the rows in which it is: row numbers and
    /// values.
    SparseRows
    transpose(const SparseRows &rows, const unsigned int n_columns)
    {
      SparseRows result;
      result.starts.assign(n_columns + 1, 0);
      for (const unsigned int column : rows.columns)
        ++result.starts[column + 1];
      for (unsigned int i = 0; i < n_columns; ++i)
        result.starts[i + 1] += result.starts[i];
      std::vector<unsigned int> next(result.starts);
      result.columns.resize(rows.columns.size());
      result.values.resize(rows.columns.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        for (unsigned int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
          {
            const unsigned int place = next[rows.columns[k]]++;
            result.columns[place]    = i;
            result.values[place]     = rows.values[k];
          }
      return result;
    }



    SparseRows
    multiply(const NodeRows   &matrix,
             const SparseRows &owned,
             const SparseRows &ghosts,
             RowSum           &sum)
    {
      SparseRows result;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        {
          const auto range = matrix.row(i);
          for (unsigned int k = range.first; k < range.second; ++k)
            {
              const bool         is_owned = matrix.column(k) < owned.size();
              const SparseRows  &rows     = is_owned ? owned : ghosts;
              const unsigned int j =
                matrix.column(k) - (is_owned ? 0 : owned.size());
              const float value = matrix.value(k);
              for (unsigned int l = rows.starts[j]; l < rows.starts[j + 1]; ++l)
                sum.add(rows.columns[l], value * rows.values[l]);
            }
          sum.move_to(result);
        }
      return result;
    }
  } // namespace



  SparseRows
  galerkin_product(const NodeRows    &matrix,
                   const SparseRows  &prolongation,
                   const unsigned int n_coarse)
  {
    const Partitioner &nodes    = matrix.column_nodes();
    const MPI_Comm     comm     = nodes.get_mpi_communicator();
    const auto         first    = first_of_ranks(n_coarse, comm);
    const unsigned int own_rank = Utilities::MPI::this_mpi_process(comm);

    RowSum           sum(first.back());
    const SparseRows product =
      multiply(matrix, prolongation, ghost_rows(prolongation, nodes), sum);
    const SparseRows restriction = transpose(prolongation, first.back());

    // for rows of other ranks, the row's number is kept as a first column
    SparseRows                         own;
    std::map<unsigned int, SparseRows> to_send;
    for (unsigned int rank = 0; rank + 1 < first.size(); ++rank)
      for (unsigned int row = first[rank]; row < first[rank + 1]; ++row)
        {
          const unsigned int begin = restriction.starts[row],
                             end   = restriction.starts[row + 1];
          if (rank != own_rank && begin == end)
            continue;
          for (unsigned int k = begin; k < end; ++k)
            {
              const unsigned int i = restriction.columns[k];
              for (unsigned int l = product.starts[i];
                   l < product.starts[i + 1];
                   ++l)
                sum.add(product.columns[l],
                        restriction.values[k] * product.values[l]);
            }
          if (rank != own_rank)
            to_send[rank].add(row, 0.f);
          sum.move_to(rank == own_rank ? own : to_send[rank]);
        }
    const auto received = Utilities::MPI::some_to_some(comm, to_send);
    if (received.empty())
      return own;

    std::vector<std::vector<std::pair<const SparseRows *, unsigned int>>> parts(
      n_coarse);
    for (unsigned int i = 0; i < n_coarse; ++i)
      parts[i].emplace_back(&own, i);
    for (const auto &message : received)
      for (unsigned int i = 0; i < message.second.size(); ++i)
        parts[message.second.columns[message.second.starts[i]] -
              first[own_rank]]
          .emplace_back(&message.second, i);
    SparseRows result;
    for (unsigned int i = 0; i < n_coarse; ++i)
      {
        for (const auto &part : parts[i])
          for (unsigned int k =
                 part.first->starts[part.second] + (part.first == &own ? 0 : 1);
               k < part.first->starts[part.second + 1];
               ++k)
            sum.add(part.first->columns[k], part.first->values[k]);
        sum.move_to(result);
      }
    return result;
  }
} // namespace Catena

#include <catena/flow/prolongation.h>

#include <algorithm>

namespace Catena
{
  namespace
  {
    /// Is row @p i the same?
    bool
    is_same_row(const SparseRows &a, const SparseRows &b, const unsigned int i)
    {
      const auto same = [&](const auto &of_a, const auto &of_b) {
        return std::equal(of_a.begin() + a.starts[i],
                          of_a.begin() + a.starts[i + 1],
                          of_b.begin() + b.starts[i],
                          of_b.begin() + b.starts[i + 1]);
      };
      return same(a.columns, b.columns) && same(a.values, b.values);
    }
  } // namespace



  Prolongation::Prolongation(const std::vector<FieldRows> &field_rows,
                             const dealii::Utilities::MPI::Partitioner &nodes)
  {
    const SparseRows &first = *field_rows.front().rows;
    for (unsigned int i = 0; i < first.size(); ++i)
      {
        const bool is_shared =
          std::all_of(field_rows.begin(),
                      field_rows.end(),
                      [&](const FieldRows &other) {
                        return is_same_row(first, *other.rows, i);
                      });
        if (is_shared)
          {
            const unsigned int length = first.starts[i + 1] - first.starts[i];
            if (by_length.size() <= length)
              by_length.resize(length + 1);
            RowsOfLength &rows = by_length[length];
            rows.rows.push_back(i);
            for (unsigned int k = first.starts[i]; k < first.starts[i + 1]; ++k)
              {
                rows.columns.push_back(nodes.global_to_local(first.columns[k]));
                rows.values.push_back(first.values[k]);
              }
            continue;
          }
        for (const FieldRows &some : field_rows)
          for (unsigned int k = some.rows->starts[i];
               k < some.rows->starts[i + 1];
               ++k)
            {
              Lanes value = {};
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                if ((some.fields >> lane) & 1U)
                  value[lane] = some.rows->values[k];
              single_entries.push_back(
                {i, nodes.global_to_local(some.rows->columns[k]), value});
            }
      }
  }



  template <typename Action>
  void
  Prolongation::for_each_entry(const Action &action) const
  {
    for (unsigned int length = 1; length < by_length.size(); ++length)
      {
        const RowsOfLength &rows   = by_length[length];
        const unsigned int *column = rows.columns.data();
        const float        *value  = rows.values.data();
        for (const unsigned int row : rows.rows)
          for (unsigned int k = 0; k < length; ++k)
            action(row, *column++, *value++);
      }
    for (const FieldEntry &entry : single_entries)
      action(entry.row, entry.column, entry.value);
  }



  void
  Prolongation::add_product(Lanes *fine, const Lanes *coarse) const
  {
    for_each_entry(
      [=](const unsigned int row, const unsigned int column, const auto value) {
        fine[row] += value * coarse[column];
      });
  }



  void
  Prolongation::add_transposed_product(Lanes *coarse, const Lanes *fine) const
  {
    for_each_entry(
      [=](const unsigned int row, const unsigned int column, const auto value) {
        coarse[column] += value * fine[row];
      });
  }
} // namespace Catena

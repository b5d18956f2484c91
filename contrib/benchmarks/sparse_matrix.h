#ifndef catena_benchmarks_sparse_matrix_h
#define catena_benchmarks_sparse_matrix_h

#include <deal.II/lac/vector.h>

#include <vector>

/**
 * A square matrix in compressed rows, columns in growing order.
 */
struct CompressedRows
{
  std::vector<unsigned long> row_starts = {0};
  std::vector<int>           columns;
  std::vector<double>        values;

  unsigned int
  n() const
  {
    return row_starts.size() - 1;
  }

  void
  vmult(dealii::Vector<double> &dst, const dealii::Vector<double> &src) const
  {
    for (unsigned int i = 0; i < n(); ++i)
      {
        double sum = 0.;
        for (unsigned long k = row_starts[i]; k < row_starts[i + 1]; ++k)
          sum += values[k] * src(columns[k]);
        dst(i) = sum;
      }
  }
};

#endif

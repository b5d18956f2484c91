#ifndef catena_benchmarks_ilut_h
#define catena_benchmarks_ilut_h

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "sparse_matrix.h"

/**
 * Incomplete LU factors with two thresholds (Saad, Numer. Linear Algebra Appl.
 * 1 (1994) 387): of each row the entries below @p drop times its mean are left
 * out, then all but the @p fill largest in L and in U. This is the ILUT of
 * Sparskit.
 */
class Ilut
{
public:
  void
  initialize(const CompressedRows &matrix,
             const unsigned int    fill,
             const double          drop)
  {
    const unsigned int n = matrix.n();
    lower = upper = CompressedRows();
    inverse_diagonal.assign(n, 0.);
    std::vector<double> work(n, 0.);
    std::vector<char>   used(n, 0);
    for (unsigned int i = 0; i < n; ++i)
      factor_row(matrix, i, fill, drop, work, used);
  }

  /// dst = (L U)^-1 src
  void
  vmult(dealii::Vector<double> &dst, const dealii::Vector<double> &src) const
  {
    const int n = inverse_diagonal.size();
    for (int i = 0; i < n; ++i)
      {
        double sum = src(i);
        for (unsigned long k = lower.row_starts[i]; k < lower.row_starts[i + 1];
             ++k)
          sum -= lower.values[k] * dst(lower.columns[k]);
        dst(i) = sum;
      }
    for (int i = n - 1; i >= 0; --i)
      {
        double sum = dst(i);
        for (unsigned long k = upper.row_starts[i]; k < upper.row_starts[i + 1];
             ++k)
          sum -= upper.values[k] * dst(upper.columns[k]);
        dst(i) = sum * inverse_diagonal[i];
      }
  }

  unsigned long
  n_entries() const
  {
    return lower.values.size() + upper.values.size() + inverse_diagonal.size();
  }

private:
  CompressedRows      lower, upper;
  std::vector<double> inverse_diagonal;

  void
  factor_row(const CompressedRows &matrix,
             const unsigned int    i,
             const unsigned int    fill,
             const double          drop,
             std::vector<double>  &work,
             std::vector<char>    &used)
  {
    std::priority_queue<int, std::vector<int>, std::greater<int>> left;
    std::vector<int> touched, right, eliminated;
    double           mean  = 0.;
    const auto       touch = [&](const int j) {
      used[j] = 1;
      touched.push_back(j);
      if (j < static_cast<int>(i))
        left.push(j);
      else if (j > static_cast<int>(i))
        right.push_back(j);
    };
    for (unsigned long k = matrix.row_starts[i]; k < matrix.row_starts[i + 1];
         ++k)
      {
        work[matrix.columns[k]] = matrix.values[k];
        touch(matrix.columns[k]);
        mean += std::abs(matrix.values[k]);
      }
    mean /= matrix.row_starts[i + 1] - matrix.row_starts[i];

    while (!left.empty())
      {
        const int j = left.top();
        left.pop();
        const double factor = work[j] * inverse_diagonal[j];
        // relative to the row as in Sparskit: factors have no units
        if (std::abs(factor) <= drop)
          continue;
        work[j] = factor;
        eliminated.push_back(j);
        for (unsigned long k = upper.row_starts[j]; k < upper.row_starts[j + 1];
             ++k)
          {
            const int c = upper.columns[k];
            if (!used[c])
              touch(c);
            work[c] -= factor * upper.values[k];
          }
      }

    keep_largest(eliminated, work, fill, 0.);
    keep_largest(right, work, fill, drop * mean);
    append(lower, eliminated, work);
    append(upper, right, work);
    // the smallest pivot Sparskit allows
    const double smallest = (1e-4 + drop) * mean;
    double       diagonal = used[i] ? work[i] : 0.;
    if (diagonal == 0.)
      diagonal = smallest;
    inverse_diagonal[i] = 1. / diagonal;
    for (const int j : touched)
      {
        work[j] = 0.;
        used[j] = 0;
      }
  }

  static void
  keep_largest(std::vector<int>          &list,
               const std::vector<double> &work,
               const unsigned int         fill,
               const double               smallest)
  {
    list.erase(std::remove_if(list.begin(),
                              list.end(),
                              [&](const int j) {
                                return std::abs(work[j]) <= smallest;
                              }),
               list.end());
    if (list.size() > fill)
      {
        std::nth_element(list.begin(),
                         list.begin() + fill,
                         list.end(),
                         [&](const int a, const int b) {
                           return std::abs(work[a]) > std::abs(work[b]);
                         });
        list.resize(fill);
      }
    std::sort(list.begin(), list.end());
  }

  static void
  append(CompressedRows            &matrix,
         const std::vector<int>    &list,
         const std::vector<double> &work)
  {
    for (const int j : list)
      {
        matrix.columns.push_back(j);
        matrix.values.push_back(work[j]);
      }
    matrix.row_starts.push_back(matrix.columns.size());
  }
};

#endif

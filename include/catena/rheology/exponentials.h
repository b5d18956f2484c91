#ifndef catena_rheology_exponentials_h
#define catena_rheology_exponentials_h

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Catena
{
  /**
   * The matrix exponentials c = exp(s) of many tensors, several at a time and
   * without their decompositions: a Taylor polynomial of s/2^k, squared k
   * times (Higham, Functions of Matrices, section 10.3).
   *
   * The error is some roundings of the largest eigenvalue of c, times the norm
   * of s; where small eigenvalues are to be accurate relative to themselves,
   * take exponential(). Norms of s can be up to 2000; beyond, and for entries
   * that are not finite, values are not finite.
   *
   * @param results resized to the number of tensors
   */
  template <int dim>
  void
  exponentials(const std::vector<dealii::SymmetricTensor<2, dim>> &tensors,
               std::vector<dealii::SymmetricTensor<2, dim>>       &results);
} // namespace Catena

#endif

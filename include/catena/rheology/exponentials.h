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
   * The error is some tens of roundings of the largest eigenvalue of c, times
   * the largest norm of the tensors. Entries of s that are not finite, or whose
   * exponential is not, give values that are not finite.
   *
   * @param exponentials resized to the number of tensors
   */
  template <int dim>
  void
  exponentials(const std::vector<dealii::SymmetricTensor<2, dim>> &tensors,
               std::vector<dealii::SymmetricTensor<2, dim>> &exponentials);
} // namespace Catena

#endif

#ifndef catena_rheology_exponential_h
#define catena_rheology_exponential_h

#include <catena/base/pack.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Catena
{
  /**
   * The matrix exponentials c = exp(s) of the tensors of a pack, without their
   * decompositions: a Taylor polynomial of s/2^k, squared k times (Higham,
   * Functions of Matrices, section 10.3).
   *
   * The error is some roundings of the largest eigenvalue of c, times the norm
   * of s; where small eigenvalues are to be accurate relative to themselves,
   * take the exponential() of a decomposition. Norms of s can be up to 2000;
   * beyond, and for entries that are not finite, values are not finite.
   */
  template <int dim>
  dealii::SymmetricTensor<2, dim, Pack>
  exponential(const dealii::SymmetricTensor<2, dim, Pack> &s);

  /// Values of a function of tensors and its derivative in a direction.
  template <int dim>
  struct ValueAndDerivative
  {
    dealii::SymmetricTensor<2, dim, Pack> value, derivative;
  };

  /**
   * The same together with the Frechet derivative d/de exp(s + e H) at e = 0 in
   * the direction H = @p direction: polynomial and squares of s + e H with
   * e^2 = 0 (Al-Mohy & Higham, SIAM J. Matrix Anal. Appl. 30 (2009) 1639). The
   * error of the derivative is some roundings of that eigenvalue, times the
   * norms of s and H.
   */
  template <int dim>
  ValueAndDerivative<dim>
  exponential(const dealii::SymmetricTensor<2, dim, Pack> &s,
              const dealii::SymmetricTensor<2, dim, Pack> &direction);
} // namespace Catena

#endif

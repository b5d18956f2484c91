#ifndef catena_rheology_spectral_h
#define catena_rheology_spectral_h

#include <catena/base/pack.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace Catena
{
  /**
   * Eigenvalues and eigenvectors of a symmetric tensor,
   * s = sum_k values[k] r_k r_k^T with r_k = column k of @p vectors.
   *
   * The eigenvalues are in no particular order. @p vectors is orthogonal to
   * rounding also where eigenvalues are equal; it may be a reflection.
   *
   * This and all functions of tensors below but logarithm() are for one tensor
   * or, with a Pack in place of a number, for some at once.
   */
  template <int dim, typename Number = double>
  struct SpectralDecomposition
  {
    std::array<Number, dim> values;

    /// Column k is the unit eigenvector of values[k]: vectors[i][k] is its
    /// i-th component.
    dealii::Tensor<2, dim, Number> vectors;
  };

  /**
   * The spectral decomposition of @p s by Jacobi rotations (Golub & Van Loan,
   * Matrix Computations, section 8.5).
   *
   * The error of the eigenvalues and of the recomposed tensor is a few
   * roundings of the largest eigenvalue, whatever the distance between them.
   * Small eigenvalues of positive definite tensors with graded rows, such as
   * the conformation in strong shear, are accurate relative to themselves
   * (Demmel & Veselic, SIAM J. Matrix Anal. Appl. 13 (1992) 1204). Entries
   * whose squares are not finite give values that are not a number.
   */
  template <int dim, typename Number>
  SpectralDecomposition<dim, Number>
  spectral_decomposition(const dealii::SymmetricTensor<2, dim, Number> &s);

  /**
   * The tensor sum_k values[k] r_k r_k^T.
   */
  template <int dim, typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  compose(const SpectralDecomposition<dim, Number> &d);

  /**
   * The matrix exponential c = exp(s) of the tensor decomposed in @p d.
   */
  template <int dim, typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  exponential(const SpectralDecomposition<dim, Number> &d);

  /**
   * The matrix logarithm s = log(c) of a symmetric positive definite tensor.
   * Near the identity s is accurate relative to c - I.
   *
   * @throws SolverError if an eigenvalue of @p c is not positive and finite.
   */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  logarithm(const dealii::SymmetricTensor<2, dim> &c);

  /**
   * The Frechet derivative of the exponential,
   * d/de exp(s + e H) at e = 0, at the tensor s decomposed in @p d and in the
   * symmetric direction H = @p direction. In the principal frame of s
   * (Daleckii & Krein 1965; Higham, Functions of Matrices, theorem 3.11)
   * @f[
   *   D_{ij} = \frac{e^{s_i} - e^{s_j}}{s_i - s_j} H_{ij}
   *          = e^{(s_i+s_j)/2}\,\frac{\sinh x}{x}\, H_{ij},
   *   \qquad x = \frac{s_i-s_j}{2},
   * @f]
   * evaluated without cancellation for equal and nearly equal eigenvalues.
   */
  template <int dim, typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  exponential_derivative(
    const SpectralDecomposition<dim, Number>      &d,
    const dealii::SymmetricTensor<2, dim, Number> &direction);

  /**
   * The Frechet derivative of the logarithm, d/de log(c + e H) at e = 0 and
   * c = exp(s), in the symmetric direction H = @p direction. The argument
   * @p d is the decomposition of s = log(c), not of c, so that this function
   * is the inverse of exponential_derivative() with the same @p d:
   * @f[
   *   D_{ij} = e^{-(s_i+s_j)/2}\,\frac{x}{\sinh x}\, H_{ij},
   *   \qquad x = \frac{s_i-s_j}{2}.
   * @f]
   */
  template <int dim, typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  logarithm_derivative(
    const SpectralDecomposition<dim, Number>      &d,
    const dealii::SymmetricTensor<2, dim, Number> &direction);

  /**
   * sinh(x)/x to rounding for |x| <= 1/2, by its Taylor series.
   */
  template <typename Number>
  inline Number
  sinh_quotient_series(const Number &x)
  {
    const Number y = x * x;
    return 1. + y / 6. *
                  (1. + y / 20. *
                          (1. + y / 42. *
                                  (1. + y / 72. *
                                          (1. + y / 110. * (1. + y / 156.)))));
  }

  /// sqrt(A : A)
  template <int dim, typename Number>
  inline Number
  frobenius_norm(const dealii::Tensor<2, dim, Number> &a)
  {
    using std::sqrt;
    Number square = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        square += a[i][j] * a[i][j];
    return sqrt(square);
  }

  /**
   * R^T A R, the components of a tensor @p a in the frame of the columns of
   * @p r.
   */
  template <int dim, typename Number>
  inline dealii::Tensor<2, dim, Number>
  to_frame(const dealii::Tensor<2, dim, Number> &a,
           const dealii::Tensor<2, dim, Number> &r)
  {
    dealii::Tensor<2, dim, Number> product, result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int j = 0; j < dim; ++j)
          product[i][j] += a[i][k] * r[k][j];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] += r[k][i] * product[k][j];
    return result;
  }

  /**
   * R A R^T for a symmetric A given by its upper triangle a[i][j], i <= j:
   * from the frame of the columns of @p r to the fixed one.
   */
  template <int dim, typename Number>
  inline dealii::SymmetricTensor<2, dim, Number>
  from_frame(const dealii::Tensor<2, dim, Number> &a,
             const dealii::Tensor<2, dim, Number> &r)
  {
    dealii::Tensor<2, dim, Number> product;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int j = 0; j < dim; ++j)
          product[i][j] += r[i][k] * (k <= j ? a[k][j] : a[j][k]);

    dealii::SymmetricTensor<2, dim, Number> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          Number sum = 0.;
          for (unsigned int k = 0; k < dim; ++k)
            sum += product[i][k] * r[j][k];
          result[i][j] = sum;
        }
    return result;
  }
} // namespace Catena

#endif

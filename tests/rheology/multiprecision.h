#ifndef catena_tests_rheology_multiprecision_h
#define catena_tests_rheology_multiprecision_h

#include <catena/rheology/spectral.h>

#include <deal.II/physics/transformations.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

/**
 * Reference values for the algebra of symmetric tensors, in 100 digits and by
 * methods of their own: Taylor series and cyclic Jacobi rotations.
 */
namespace Reference
{
  using Number = boost::multiprecision::cpp_bin_float_100;

  template <int n>
  using Matrix = std::array<std::array<Number, n>, n>;

  template <int dim, typename TensorType>
  Matrix<dim>
  to_matrix(const TensorType &a)
  {
    Matrix<dim> m;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        m[i][j] = a[i][j];
    return m;
  }

  template <std::size_t n>
  std::array<std::array<Number, n>, n>
  identity()
  {
    std::array<std::array<Number, n>, n> m{};
    for (std::size_t i = 0; i < n; ++i)
      m[i][i] = 1;
    return m;
  }

  template <typename MatrixType>
  MatrixType
  product(const MatrixType &a, const MatrixType &b)
  {
    MatrixType c{};
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a.size(); ++j)
        for (std::size_t k = 0; k < a.size(); ++k)
          c[i][j] += a[i][k] * b[k][j];
    return c;
  }

  template <typename MatrixType>
  MatrixType
  sum(const Number     &x,
      const MatrixType &a,
      const Number     &y,
      const MatrixType &b)
  {
    MatrixType c;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a.size(); ++j)
        c[i][j] = x * a[i][j] + y * b[i][j];
    return c;
  }

  template <typename MatrixType>
  MatrixType
  transpose(MatrixType a)
  {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        std::swap(a[i][j], a[j][i]);
    return a;
  }

  template <typename MatrixType>
  Number
  norm(const MatrixType &a)
  {
    Number square = 0;
    for (const auto &row : a)
      for (const Number &entry : row)
        square += entry * entry;
    return sqrt(square);
  }

  /// exp(a) of any square matrix: Taylor series, scaling and squaring.
  template <typename MatrixType>
  MatrixType
  taylor_exponential(const MatrixType &a)
  {
    constexpr int    n_squarings = 12;
    const MatrixType zero{};
    const MatrixType scaled = sum(ldexp(Number(1), -n_squarings), a, 0, zero);

    MatrixType result = identity<std::tuple_size<MatrixType>::value>();
    MatrixType term   = result;
    for (int k = 1; k < 90; ++k)
      {
        term   = sum(Number(1) / k, product(term, scaled), 0, zero);
        result = sum(1, result, 1, term);
      }
    for (int k = 0; k < n_squarings; ++k)
      result = product(result, result);
    return result;
  }

  /// The eigenvalues of s, and the matrix whose columns are its eigenvectors.
  template <int dim>
  std::pair<std::array<Number, dim>, Matrix<dim>>
  eigen(Matrix<dim> s)
  {
    Matrix<dim> r = identity<dim>();
    for (int sweep = 0; sweep < 12; ++sweep)
      for (int p = 0; p < dim; ++p)
        for (int q = p + 1; q < dim; ++q)
          if (s[p][q] != 0)
            {
              const Number angle    = atan2(2 * s[p][q], s[q][q] - s[p][p]) / 2;
              Matrix<dim>  rotation = identity<dim>();
              rotation[p][p] = rotation[q][q] = cos(angle);
              rotation[p][q]                  = sin(angle);
              rotation[q][p]                  = -sin(angle);
              s = product(transpose(rotation), product(s, rotation));
              r = product(r, rotation);
            }
    std::array<Number, dim> values;
    for (int i = 0; i < dim; ++i)
      values[i] = s[i][i];
    return {values, r};
  }

  template <int dim>
  Matrix<dim>
  logarithm(const Matrix<dim> &c)
  {
    const auto [values, r] = eigen<dim>(c);
    Matrix<dim> diagonal{};
    for (int i = 0; i < dim; ++i)
      diagonal[i][i] = log(values[i]);
    return product(r, product(diagonal, transpose(r)));
  }

  /// The Frechet derivative of exp at s (or of log at exp(s)) in direction h.
  template <int dim>
  Matrix<dim>
  derivative(const Matrix<dim> &s, const Matrix<dim> &h, const bool of_log)
  {
    const auto [values, r] = eigen<dim>(s);
    Matrix<dim> result     = product(transpose(r), product(h, r));
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          const Number difference = values[i] - values[j];
          const Number quotient =
            abs(difference) < 1e-40 ?
              exp((values[i] + values[j]) / 2) :
              Number((exp(values[i]) - exp(values[j])) / difference);
          result[i][j] *= (of_log ? Number(1 / quotient) : quotient);
        }
    return product(r, product(result, transpose(r)));
  }

  /// The largest deviation of @p value from @p expected, in roundings of
  /// @p scale.
  template <typename TensorType, typename MatrixType>
  double
  roundings(const TensorType &value,
            const MatrixType &expected,
            const Number     &scale)
  {
    constexpr int dim       = std::tuple_size<MatrixType>::value;
    const Number  deviation = norm(sum(1, to_matrix<dim>(value), -1, expected));
    return static_cast<double>(
      Number(deviation / (scale * std::numeric_limits<double>::epsilon())));
  }

  template <int dim>
  dealii::Tensor<2, dim>
  random_rotation(std::mt19937 &generator)
  {
    std::normal_distribution<double> normal;
    namespace Rotations = dealii::Physics::Transformations::Rotations;
    if constexpr (dim == 2)
      return Rotations::rotation_matrix_2d(3. * normal(generator));
    else
      {
        dealii::Tensor<1, dim> axis;
        for (unsigned int i = 0; i < dim; ++i)
          axis[i] = normal(generator);
        return Rotations::rotation_matrix_3d(axis / axis.norm(),
                                             3. * normal(generator));
      }
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim>
  random_symmetric(std::mt19937 &generator)
  {
    std::normal_distribution<double> normal;
    dealii::SymmetricTensor<2, dim>  s;
    for (unsigned int i = 0; i < s.n_independent_components; ++i)
      s.access_raw_entry(i) = normal(generator);
    return s;
  }

  /// Randomly turned symmetric tensors with eigenvalues that are far apart,
  /// equal, almost equal and widely spread.
  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>>
  hard_cases(std::mt19937 &generator)
  {
    std::vector<std::array<double, 3>> eigenvalues = {{{0., 0., 0.}},
                                                      {{1., 1., 1.}},
                                                      {{2., 2., -1.}},
                                                      {{-3., 1., 1.}},
                                                      {{1., -1., 0.}},
                                                      {{1., 0., 0.}},
                                                      {{10., -10., 0.}},
                                                      {{12., -1e-9, -12.}},
                                                      {{1e-10, -3e-10, 2e-10}},
                                                      {{1e-12, 1e-6, 1.}}};
    for (int exponent = -4; exponent >= -16; --exponent)
      {
        const double small = std::pow(10., exponent);
        eigenvalues.push_back({{1. + small, 1., -2.}});
        eigenvalues.push_back({{1. + small, 1., 1. - 2. * small}});
        eigenvalues.push_back({{small, 0., -small}});
      }
    for (const double distance : {0.9, 0.99, 1., 1.01, 1.1})
      eigenvalues.push_back({{0.3 + distance, 0.3, 0.3 - distance}});

    std::vector<dealii::SymmetricTensor<2, dim>> cases;
    for (const auto &values : eigenvalues)
      for (unsigned int n = 0; n < 5; ++n)
        {
          Catena::SpectralDecomposition<dim> d;
          std::copy_n(values.begin(), dim, d.values.begin());
          d.vectors = random_rotation<dim>(generator);
          cases.push_back(Catena::compose(d));
        }
    for (unsigned int n = 0; n < 50; ++n)
      cases.push_back(2. * random_symmetric<dim>(generator));
    return cases;
  }
} // namespace Reference

#endif

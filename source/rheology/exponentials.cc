#include <catena/rheology/exponentials.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <experimental/simd>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    namespace simd = std::experimental;

    using Number = simd::native_simd<double>;

    /// The Taylor polynomial of degree 11 is exact to rounding up to this norm.
    constexpr double taylor_norm = 0.25;
    /// Beyond, values are not finite.
    constexpr double largest_norm = 2000.;

    /**
     * Symmetric tensors, one in each lane, that commute: their products are
     * symmetric, too.
     */
    template <int dim>
    struct Symmetric
    {
      Number a[dim][dim]; // a[i][j], i <= j

      const Number &
      operator()(const int i, const int j) const
      {
        return i <= j ? a[i][j] : a[j][i];
      }

      Symmetric
      operator*(const Symmetric &b) const
      {
        Symmetric result;
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            {
              result.a[i][j] = (*this)(i, 0) * b(0, j);
              for (int k = 1; k < dim; ++k)
                result.a[i][j] += (*this)(i, k) * b(k, j);
            }
        return result;
      }

      Symmetric &
      operator+=(const Symmetric &b)
      {
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            a[i][j] += b.a[i][j];
        return *this;
      }

      Number
      square() const
      {
        Number sum = 0.;
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            sum += (i == j ? 1. : 2.) * a[i][j] * a[i][j];
        return sum;
      }
    };



    /// c_0 I + c_1 x + c_2 x^2
    template <int dim>
    Symmetric<dim>
    quadratic(const double          c_0,
              const double          c_1,
              const double          c_2,
              const Symmetric<dim> &x,
              const Symmetric<dim> &x_2)
    {
      Symmetric<dim> result;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          result.a[i][j] =
            c_1 * x.a[i][j] + c_2 * x_2.a[i][j] + (i == j ? c_0 : 0.);
      return result;
    }



    /// The Taylor polynomial of degree 11, by Paterson and Stockmeyer.
    template <int dim>
    Symmetric<dim>
    taylor(const Symmetric<dim> &x)
    {
      constexpr std::array<double, 12> c   = {{1.,
                                               1.,
                                               1. / 2.,
                                               1. / 6.,
                                               1. / 24.,
                                               1. / 120.,
                                               1. / 720.,
                                               1. / 5040.,
                                               1. / 40320.,
                                               1. / 362880.,
                                               1. / 3628800.,
                                               1. / 39916800.}};
      const Symmetric<dim>             x_2 = x * x, x_3 = x_2 * x;
      Symmetric<dim> sum = quadratic(c[9], c[10], c[11], x, x_2);
      for (int n = 6; n >= 0; n -= 3)
        {
          sum = sum * x_3;
          sum += quadratic(c[n], c[n + 1], c[n + 2], x, x_2);
        }
      return sum;
    }



    template <int dim>
    Symmetric<dim>
    exponential(Symmetric<dim> x)
    {
      const Number squares     = x.square();
      Number       n_squarings = 0., scale = 1.;
      for (unsigned int lane = 0; lane < Number::size(); ++lane)
        {
          const double norm = std::sqrt(squares[lane]);
          if (norm > taylor_norm)
            n_squarings[lane] =
              std::ilogb(std::min(norm, largest_norm) / taylor_norm) + 1;
          scale[lane] = std::ldexp(1., -static_cast<int>(n_squarings[lane]));
        }
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          x.a[i][j] *= scale;

      Symmetric<dim> result = taylor(x);
      for (int n = 0; any_of(n_squarings > n); ++n)
        {
          const Symmetric<dim> squared = result * result;
          for (int i = 0; i < dim; ++i)
            for (int j = i; j < dim; ++j)
              where(n_squarings > n, result.a[i][j]) = squared.a[i][j];
        }
      return result;
    }
  } // namespace



  template <int dim>
  void
  exponentials(const std::vector<SymmetricTensor<2, dim>> &tensors,
               std::vector<SymmetricTensor<2, dim>>       &results)
  {
    results.resize(tensors.size());
    for (std::size_t first = 0; first < tensors.size(); first += Number::size())
      {
        Symmetric<dim> x;
        // the last tensor also fills the lanes that are left
        for (unsigned int lane = 0; lane < Number::size(); ++lane)
          {
            const auto &s = tensors[std::min(first + lane, tensors.size() - 1)];
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                x.a[i][j][lane] = s[i][j];
          }
        const Symmetric<dim> c = exponential(x);
        for (unsigned int lane = 0;
             lane < Number::size() && first + lane < tensors.size();
             ++lane)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              results[first + lane][i][j] = c.a[i][j][lane];
      }
  }



  template void
  exponentials<2>(const std::vector<SymmetricTensor<2, 2>> &,
                  std::vector<SymmetricTensor<2, 2>> &);
  template void
  exponentials<3>(const std::vector<SymmetricTensor<2, 3>> &,
                  std::vector<SymmetricTensor<2, 3>> &);
} // namespace Catena

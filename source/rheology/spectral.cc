#include <catena/base/exceptions.h>
#include <catena/rheology/spectral.h>

#include <limits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    namespace simd = std::experimental;

    /// A number by itself, with the functions of packs.
    using Single = simd::simd<double, simd::simd_abi::scalar>;

    inline Single
    to_lanes(const double x)
    {
      return x;
    }

    inline Pack
    to_lanes(const Pack &x)
    {
      return x;
    }

    inline double
    from_lanes(const Single &x)
    {
      return x[0];
    }

    inline Pack
    from_lanes(const Pack &x)
    {
      return x;
    }



    /**
     * Symmetric tensors on their way to diagonal form, one in each lane of
     * @p Number, together with the product of the rotations applied to them.
     */
    template <int dim, typename Number>
    struct Jacobi
    {
      Number a[dim][dim];
      Number r[dim][dim];

      /// Rotate the plane (p, q) so that a[p][q], p < q, becomes zero where
      /// that changes an eigenvalue or an eigenvector beyond rounding, judged
      /// by both rows it couples; returns whether it does anywhere.
      template <int p, int q>
      bool
      rotate(const Number &floor)
      {
        constexpr double epsilon = std::numeric_limits<double>::epsilon() / 8.;
        const Number     square  = a[p][q] * a[p][q];
        const auto       rotates =
          square > epsilon * epsilon * abs(a[p][p] * a[q][q]) && square > floor;
        if (none_of(rotates))
          return false;

        // With tan(2 theta) = twice/difference: the smaller of the two angles.
        Number difference           = a[q][q] - a[p][p];
        Number twice                = 2. * a[p][q];
        where(!rotates, difference) = 1.;
        where(!rotates, twice)      = 0.;
        const Number root    = sqrt(difference * difference + twice * twice);
        const Number sum     = difference + copysign(root, difference);
        const Number scale   = 1. / sqrt(sum * sum + twice * twice);
        const Number tangent = twice / sum;
        const Number cosine  = abs(sum) * scale;
        const Number sine    = copysign(scale, difference) * twice;

        a[p][p] -= tangent * a[p][q];
        a[q][q] += tangent * a[p][q];
        where(rotates, a[p][q]) = 0.;

        if constexpr (dim == 3)
          {
            constexpr int other  = 3 - p - q;
            Number       &first  = (other < p ? a[other][p] : a[p][other]);
            Number       &second = (other < q ? a[other][q] : a[q][other]);
            const Number  old    = first;
            first                = cosine * old - sine * second;
            second               = sine * old + cosine * second;
          }

        for (int i = 0; i < dim; ++i)
          {
            const Number old = r[i][p];
            r[i][p]          = cosine * old - sine * r[i][q];
            r[i][q]          = sine * old + cosine * r[i][q];
          }
        return true;
      }

      bool
      sweep(const Number &floor)
      {
        bool changed = rotate<0, 1>(floor);
        if constexpr (dim == 3)
          {
            changed |= rotate<0, 2>(floor);
            changed |= rotate<1, 2>(floor);
          }
        return changed;
      }

      void
      diagonalize()
      {
        Number square = 0.;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              r[i][j] = (i == j ? 1. : 0.);
              square += a[i][j] * a[i][j];
            }

        // Convergence is quadratic: four sweeps are the rule.
        constexpr unsigned int max_sweeps = 20;
        const Number           floor      = 1e-60 * square;
        for (unsigned int n = 0; n < max_sweeps && sweep(floor); ++n)
          {}

        for (unsigned int i = 0; i < dim; ++i)
          where(!isfinite(square), a[i][i]) =
            std::numeric_limits<double>::quiet_NaN();
      }
    };
  } // namespace



  template <int dim, typename Number>
  SpectralDecomposition<dim, Number>
  spectral_decomposition(const SymmetricTensor<2, dim, Number> &s)
  {
    Jacobi<dim, decltype(to_lanes(Number()))> jacobi;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        jacobi.a[i][j] = to_lanes(s[i][j]);
    jacobi.diagonalize();

    SpectralDecomposition<dim, Number> d;
    for (unsigned int i = 0; i < dim; ++i)
      {
        d.values[i] = from_lanes(jacobi.a[i][i]);
        for (unsigned int j = 0; j < dim; ++j)
          d.vectors[i][j] = from_lanes(jacobi.r[i][j]);
      }
    return d;
  }



  template <int dim, typename Number>
  SymmetricTensor<2, dim, Number>
  compose(const SpectralDecomposition<dim, Number> &d)
  {
    SymmetricTensor<2, dim, Number> s;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          Number sum = 0.;
          for (unsigned int k = 0; k < dim; ++k)
            sum += d.values[k] * d.vectors[i][k] * d.vectors[j][k];
          s[i][j] = sum;
        }
    return s;
  }



  template <int dim, typename Number>
  SymmetricTensor<2, dim, Number>
  exponential(const SpectralDecomposition<dim, Number> &d)
  {
    using std::exp;
    SpectralDecomposition<dim, Number> c = d;
    for (Number &value : c.values)
      value = exp(value);
    return compose(c);
  }



  template <int dim>
  SymmetricTensor<2, dim>
  logarithm(const SymmetricTensor<2, dim> &c)
  {
    const SymmetricTensor<2, dim> departure =
      c - unit_symmetric_tensor<dim, double>();
    const bool near_identity = departure.norm() < 0.5;

    SpectralDecomposition<dim> d =
      spectral_decomposition(near_identity ? departure : c);
    for (double &value : d.values)
      {
        if (!near_identity && !(value > 0. && std::isfinite(value)))
          throw SolverError("The conformation tensor has the eigenvalue " +
                            std::to_string(value) +
                            ", so it has no logarithm: use a smaller time "
                            "step or a finer mesh.");
        value = (near_identity ? std::log1p(value) : std::log(value));
      }
    return compose(d);
  }



  namespace
  {
    /**
     * The divided difference (e^{s_i} - e^{s_j})/(s_i - s_j) of the
     * exponential, from the exponentials of half the arguments.
     */
    template <typename Number>
    inline Number
    divided_difference(const Number &s_i,
                       const Number &s_j,
                       const Number &root_i,
                       const Number &root_j)
    {
      using std::abs;
      const Number difference = s_i - s_j;
      const auto   is_small   = abs(difference) <= 1.;
      return select(is_small,
                    root_i * root_j * sinh_quotient_series(0.5 * difference),
                    (root_i * root_i - root_j * root_j) /
                      select(is_small, Number(1.), difference));
    }



    template <int dim, typename Number>
    SymmetricTensor<2, dim, Number>
    derivative(const SpectralDecomposition<dim, Number> &d,
               const SymmetricTensor<2, dim, Number>    &direction,
               const bool                                of_logarithm)
    {
      using std::exp;
      std::array<Number, dim> roots;
      for (unsigned int i = 0; i < dim; ++i)
        roots[i] = exp(0.5 * d.values[i]);

      auto h = to_frame(Tensor<2, dim, Number>(direction), d.vectors);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            const Number factor =
              divided_difference(d.values[i], d.values[j], roots[i], roots[j]);
            h[i][j] *= (of_logarithm ? 1. / factor : factor);
          }
      return from_frame(h, d.vectors);
    }
  } // namespace



  template <int dim, typename Number>
  SymmetricTensor<2, dim, Number>
  exponential_derivative(const SpectralDecomposition<dim, Number> &d,
                         const SymmetricTensor<2, dim, Number>    &direction)
  {
    return derivative(d, direction, false);
  }



  template <int dim, typename Number>
  SymmetricTensor<2, dim, Number>
  logarithm_derivative(const SpectralDecomposition<dim, Number> &d,
                       const SymmetricTensor<2, dim, Number>    &direction)
  {
    return derivative(d, direction, true);
  }



  template SymmetricTensor<2, 2>
  logarithm(const SymmetricTensor<2, 2> &);
  template SpectralDecomposition<2, double>
  spectral_decomposition(const SymmetricTensor<2, 2, double> &);
  template SymmetricTensor<2, 2, double>
  compose(const SpectralDecomposition<2, double> &);
  template SymmetricTensor<2, 2, double>
  exponential(const SpectralDecomposition<2, double> &);
  template SymmetricTensor<2, 2, double>
  exponential_derivative(const SpectralDecomposition<2, double> &,
                         const SymmetricTensor<2, 2, double> &);
  template SymmetricTensor<2, 2, double>
  logarithm_derivative(const SpectralDecomposition<2, double> &,
                       const SymmetricTensor<2, 2, double> &);
  template SpectralDecomposition<2, Pack>
  spectral_decomposition(const SymmetricTensor<2, 2, Pack> &);
  template SymmetricTensor<2, 2, Pack>
  compose(const SpectralDecomposition<2, Pack> &);
  template SymmetricTensor<2, 2, Pack>
  exponential(const SpectralDecomposition<2, Pack> &);
  template SymmetricTensor<2, 2, Pack>
  exponential_derivative(const SpectralDecomposition<2, Pack> &,
                         const SymmetricTensor<2, 2, Pack> &);
  template SymmetricTensor<2, 2, Pack>
  logarithm_derivative(const SpectralDecomposition<2, Pack> &,
                       const SymmetricTensor<2, 2, Pack> &);

  template SymmetricTensor<2, 3>
  logarithm(const SymmetricTensor<2, 3> &);
  template SpectralDecomposition<3, double>
  spectral_decomposition(const SymmetricTensor<2, 3, double> &);
  template SymmetricTensor<2, 3, double>
  compose(const SpectralDecomposition<3, double> &);
  template SymmetricTensor<2, 3, double>
  exponential(const SpectralDecomposition<3, double> &);
  template SymmetricTensor<2, 3, double>
  exponential_derivative(const SpectralDecomposition<3, double> &,
                         const SymmetricTensor<2, 3, double> &);
  template SymmetricTensor<2, 3, double>
  logarithm_derivative(const SpectralDecomposition<3, double> &,
                       const SymmetricTensor<2, 3, double> &);
  template SpectralDecomposition<3, Pack>
  spectral_decomposition(const SymmetricTensor<2, 3, Pack> &);
  template SymmetricTensor<2, 3, Pack>
  compose(const SpectralDecomposition<3, Pack> &);
  template SymmetricTensor<2, 3, Pack>
  exponential(const SpectralDecomposition<3, Pack> &);
  template SymmetricTensor<2, 3, Pack>
  exponential_derivative(const SpectralDecomposition<3, Pack> &,
                         const SymmetricTensor<2, 3, Pack> &);
  template SymmetricTensor<2, 3, Pack>
  logarithm_derivative(const SpectralDecomposition<3, Pack> &,
                       const SymmetricTensor<2, 3, Pack> &);
} // namespace Catena

#include <catena/base/exceptions.h>
#include <catena/rheology/spectral.h>

#include <algorithm>
#include <limits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * A symmetric tensor on its way to diagonal form, together with the
     * product of the rotations applied to it.
     */
    template <int dim>
    struct Jacobi
    {
      double a[dim][dim];
      double r[dim][dim];

      /// Whether a[p][q] changes no eigenvalue and no eigenvector beyond
      /// rounding, judged by both rows it couples.
      template <int p, int q>
      bool
      negligible(const double floor) const
      {
        constexpr double epsilon = std::numeric_limits<double>::epsilon() / 8.;
        const double     square  = a[p][q] * a[p][q];
        return !(square > epsilon * epsilon * std::abs(a[p][p] * a[q][q]) &&
                 square > floor);
      }

      /// Rotate the plane (p, q) so that a[p][q], p < q, becomes zero.
      template <int p, int q>
      void
      rotate()
      {
        // With tan(2 theta) = twice/difference: the smaller of the two angles.
        const double difference = a[q][q] - a[p][p];
        const double twice      = 2. * a[p][q];
        const double root  = std::sqrt(difference * difference + twice * twice);
        const double sum   = difference + std::copysign(root, difference);
        const double scale = 1. / std::sqrt(sum * sum + twice * twice);
        const double tangent = twice / sum;
        const double cosine  = std::abs(sum) * scale;
        const double sine    = std::copysign(scale, difference) * twice;

        a[p][p] -= tangent * a[p][q];
        a[q][q] += tangent * a[p][q];
        a[p][q] = 0.;

        if constexpr (dim == 3)
          {
            constexpr int other  = 3 - p - q;
            double       &first  = (other < p ? a[other][p] : a[p][other]);
            double       &second = (other < q ? a[other][q] : a[q][other]);
            const double  old    = first;
            first                = cosine * old - sine * second;
            second               = sine * old + cosine * second;
          }

        for (int i = 0; i < dim; ++i)
          {
            const double old = r[i][p];
            r[i][p]          = cosine * old - sine * r[i][q];
            r[i][q]          = sine * old + cosine * r[i][q];
          }
      }

      /// One rotation if it has an effect; returns whether it had.
      template <int p, int q>
      bool
      reduce(const double floor)
      {
        if (negligible<p, q>(floor))
          return false;
        rotate<p, q>();
        return true;
      }

      bool
      sweep(const double floor)
      {
        bool changed = reduce<0, 1>(floor);
        if constexpr (dim == 3)
          {
            changed |= reduce<0, 2>(floor);
            changed |= reduce<1, 2>(floor);
          }
        return changed;
      }
    };
  } // namespace



  template <int dim>
  SpectralDecomposition<dim>
  spectral_decomposition(const SymmetricTensor<2, dim> &s)
  {
    Jacobi<dim> jacobi;
    double      square = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          jacobi.a[i][j] = s[i][j];
          jacobi.r[i][j] = (i == j ? 1. : 0.);
          square += s[i][j] * s[i][j];
        }

    // Convergence is quadratic: four sweeps are the rule.
    constexpr unsigned int max_sweeps = 20;
    const double           floor      = 1e-60 * square;
    for (unsigned int n = 0; n < max_sweeps && jacobi.sweep(floor); ++n)
      {}

    if (!std::isfinite(square))
      for (unsigned int i = 0; i < dim; ++i)
        jacobi.a[i][i] = std::numeric_limits<double>::quiet_NaN();

    SpectralDecomposition<dim> d;
    for (unsigned int i = 0; i < dim; ++i)
      {
        d.values[i] = jacobi.a[i][i];
        for (unsigned int j = 0; j < dim; ++j)
          d.vectors[i][j] = jacobi.r[i][j];
      }
    return d;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  compose(const SpectralDecomposition<dim> &d)
  {
    SymmetricTensor<2, dim> s;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          double sum = 0.;
          for (unsigned int k = 0; k < dim; ++k)
            sum += d.values[k] * d.vectors[i][k] * d.vectors[j][k];
          s[i][j] = sum;
        }
    return s;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  exponential(const SpectralDecomposition<dim> &d)
  {
    SpectralDecomposition<dim> c = d;
    for (double &value : c.values)
      value = std::exp(value);
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
    inline double
    divided_difference(const double s_i,
                       const double s_j,
                       const double root_i,
                       const double root_j)
    {
      if (std::abs(s_i - s_j) <= 1.)
        return root_i * root_j * sinh_quotient_series(0.5 * (s_i - s_j));
      return (root_i * root_i - root_j * root_j) / (s_i - s_j);
    }



    template <int dim>
    SymmetricTensor<2, dim>
    derivative(const SpectralDecomposition<dim> &d,
               const SymmetricTensor<2, dim>    &direction,
               const bool                        of_logarithm)
    {
      std::array<double, dim> roots;
      for (unsigned int i = 0; i < dim; ++i)
        roots[i] = std::exp(0.5 * d.values[i]);

      Tensor<2, dim> h = to_frame(Tensor<2, dim>(direction), d.vectors);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            const double factor =
              divided_difference(d.values[i], d.values[j], roots[i], roots[j]);
            h[i][j] *= (of_logarithm ? 1. / factor : factor);
          }
      return from_frame(h, d.vectors);
    }
  } // namespace



  template <int dim>
  SymmetricTensor<2, dim>
  exponential_derivative(const SpectralDecomposition<dim> &d,
                         const SymmetricTensor<2, dim>    &direction)
  {
    return derivative(d, direction, false);
  }



  template <int dim>
  SymmetricTensor<2, dim>
  logarithm_derivative(const SpectralDecomposition<dim> &d,
                       const SymmetricTensor<2, dim>    &direction)
  {
    return derivative(d, direction, true);
  }



  template SpectralDecomposition<2>
  spectral_decomposition(const SymmetricTensor<2, 2> &);
  template SymmetricTensor<2, 2>
  compose(const SpectralDecomposition<2> &);
  template SymmetricTensor<2, 2>
  exponential(const SpectralDecomposition<2> &);
  template SymmetricTensor<2, 2>
  logarithm(const SymmetricTensor<2, 2> &);
  template SymmetricTensor<2, 2>
  exponential_derivative(const SpectralDecomposition<2> &,
                         const SymmetricTensor<2, 2> &);
  template SymmetricTensor<2, 2>
  logarithm_derivative(const SpectralDecomposition<2> &,
                       const SymmetricTensor<2, 2> &);

  template SpectralDecomposition<3>
  spectral_decomposition(const SymmetricTensor<2, 3> &);
  template SymmetricTensor<2, 3>
  compose(const SpectralDecomposition<3> &);
  template SymmetricTensor<2, 3>
  exponential(const SpectralDecomposition<3> &);
  template SymmetricTensor<2, 3>
  logarithm(const SymmetricTensor<2, 3> &);
  template SymmetricTensor<2, 3>
  exponential_derivative(const SpectralDecomposition<3> &,
                         const SymmetricTensor<2, 3> &);
  template SymmetricTensor<2, 3>
  logarithm_derivative(const SpectralDecomposition<3> &,
                       const SymmetricTensor<2, 3> &);
} // namespace Catena

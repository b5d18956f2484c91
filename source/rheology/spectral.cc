#include <catena/base/exceptions.h>
#include <catena/rheology/spectral.h>

#include <algorithm>
#include <limits>

#include <experimental/simd>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    namespace simd = std::experimental;

    /**
     * Symmetric tensors on their way to diagonal form, one in each lane of
     * @p Number, together with the product of the rotations applied to them.
     */
    template <int dim, typename Number>
    struct Jacobi
    {
      Number a[dim][dim];
      Number r[dim][dim];

      /// Takes a tensor into a lane.
      void
      set(const unsigned int lane, const SymmetricTensor<2, dim> &s)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            a[i][j][lane] = s[i][j];
      }

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

      SpectralDecomposition<dim>
      result(const unsigned int lane) const
      {
        SpectralDecomposition<dim> d;
        for (unsigned int i = 0; i < dim; ++i)
          {
            d.values[i] = a[i][i][lane];
            for (unsigned int j = 0; j < dim; ++j)
              d.vectors[i][j] = r[i][j][lane];
          }
        return d;
      }
    };
  } // namespace



  template <int dim>
  SpectralDecomposition<dim>
  spectral_decomposition(const SymmetricTensor<2, dim> &s)
  {
    Jacobi<dim, simd::simd<double, simd::simd_abi::scalar>> jacobi;
    jacobi.set(0, s);
    jacobi.diagonalize();
    return jacobi.result(0);
  }



  template <int dim>
  void
  spectral_decompositions(const std::vector<SymmetricTensor<2, dim>> &tensors,
                          std::vector<SpectralDecomposition<dim>>    &spectra)
  {
    using Lanes = simd::native_simd<double>;
    spectra.resize(tensors.size());
    for (std::size_t first = 0; first < tensors.size(); first += Lanes::size())
      {
        Jacobi<dim, Lanes> jacobi;
        // the last tensor also fills the lanes that are left
        for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
          jacobi.set(lane, tensors[std::min(first + lane, tensors.size() - 1)]);
        jacobi.diagonalize();
        for (unsigned int lane = 0;
             lane < Lanes::size() && first + lane < tensors.size();
             ++lane)
          spectra[first + lane] = jacobi.result(lane);
      }
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
  template void
  spectral_decompositions(const std::vector<SymmetricTensor<2, 2>> &,
                          std::vector<SpectralDecomposition<2>> &);
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
  template void
  spectral_decompositions(const std::vector<SymmetricTensor<2, 3>> &,
                          std::vector<SpectralDecomposition<3>> &);
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

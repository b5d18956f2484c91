#include <catena/rheology/exponential.h>

#include <array>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// The Taylor polynomial of degree 11 is exact to rounding up to this norm,
    /// its derivative up to half of it.
    constexpr double taylor_norm = 0.25;
    /// Beyond, values are not finite.
    constexpr double largest_norm = 2000.;

    template <int dim>
    using Tensors = SymmetricTensor<2, dim, Pack>;

    template <int dim>
    constexpr unsigned int n_entries = Tensors<dim>::n_independent_components;

    /// Where component (i,j) is stored: SymmetricTensor::operator[] searches.
    template <int dim>
    constexpr unsigned int
    entry(const unsigned int i, const unsigned int j)
    {
      return i == j ? i : dim - 1 + i + j;
    }



    /// sum += x y, of which the upper triangle is taken
    template <int dim>
    void
    add_product(Tensors<dim> &sum, const Tensors<dim> &x, const Tensors<dim> &y)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            Pack &element = sum.access_raw_entry(entry<dim>(i, j));
            for (unsigned int k = 0; k < dim; ++k)
              element += x.access_raw_entry(entry<dim>(i, k)) *
                         y.access_raw_entry(entry<dim>(k, j));
          }
    }

    /// The product of tensors that commute: it is symmetric, too.
    template <int dim>
    Tensors<dim>
    product(const Tensors<dim> &x, const Tensors<dim> &y)
    {
      Tensors<dim> result;
      add_product<dim>(result, x, y);
      return result;
    }

    template <int dim>
    ValueAndDerivative<dim>
    product(const ValueAndDerivative<dim> &x, const ValueAndDerivative<dim> &y)
    {
      ValueAndDerivative<dim> result;
      add_product<dim>(result.value, x.value, y.value);
      add_product<dim>(result.derivative, x.value, y.derivative);
      add_product<dim>(result.derivative, x.derivative, y.value);
      return result;
    }



    template <int dim>
    void
    scale(Tensors<dim> &x, const Pack &factor)
    {
      x *= factor;
    }

    template <int dim>
    void
    scale(ValueAndDerivative<dim> &x, const Pack &factor)
    {
      x.value *= factor;
      x.derivative *= factor;
    }



    /// sum += c_0 I + c_1 x + c_2 x^2
    template <int dim>
    void
    add_quadratic(Tensors<dim>       &sum,
                  const double        c_0,
                  const double        c_1,
                  const double        c_2,
                  const Tensors<dim> &x,
                  const Tensors<dim> &x_2)
    {
      for (unsigned int k = 0; k < n_entries<dim>; ++k)
        sum.access_raw_entry(k) += c_1 * x.access_raw_entry(k) +
                                   c_2 * x_2.access_raw_entry(k) +
                                   (k < dim ? c_0 : 0.);
    }

    template <int dim>
    void
    add_quadratic(ValueAndDerivative<dim>       &sum,
                  const double                   c_0,
                  const double                   c_1,
                  const double                   c_2,
                  const ValueAndDerivative<dim> &x,
                  const ValueAndDerivative<dim> &x_2)
    {
      add_quadratic<dim>(sum.value, c_0, c_1, c_2, x.value, x_2.value);
      add_quadratic<dim>(
        sum.derivative, 0., c_1, c_2, x.derivative, x_2.derivative);
    }



    /// x = y where the condition holds
    template <int dim>
    void
    replace(const Pack::mask_type &condition,
            Tensors<dim>          &x,
            const Tensors<dim>    &y)
    {
      for (unsigned int k = 0; k < n_entries<dim>; ++k)
        where(condition, x.access_raw_entry(k)) = y.access_raw_entry(k);
    }

    template <int dim>
    void
    replace(const Pack::mask_type         &condition,
            ValueAndDerivative<dim>       &x,
            const ValueAndDerivative<dim> &y)
    {
      replace<dim>(condition, x.value, y.value);
      replace<dim>(condition, x.derivative, y.derivative);
    }



    /// The Taylor polynomial of degree 11, by Paterson and Stockmeyer.
    template <int dim, typename Element>
    Element
    taylor(const Element &x)
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
      const Element                    x_2 = product<dim>(x, x);
      const Element                    x_3 = product<dim>(x_2, x);
      Element                          sum = {};
      add_quadratic<dim>(sum, c[9], c[10], c[11], x, x_2);
      for (int n = 6; n >= 0; n -= 3)
        {
          sum = product<dim>(sum, x_3);
          add_quadratic<dim>(sum, c[n], c[n + 1], c[n + 2], x, x_2);
        }
      return sum;
    }



    /// The exponential of @p x, which is s and what goes with it.
    template <int dim, typename Element>
    Element
    scale_and_square(const Tensors<dim> &s,
                     const double        norm_without_squaring,
                     Element             x)
    {
      const Pack norm        = min(sqrt(s * s), Pack(largest_norm));
      Pack       n_squarings = 0., factor = 1.;
      while (any_of(factor * norm > norm_without_squaring))
        {
          const Pack::mask_type is_large =
            factor * norm > norm_without_squaring;
          where(is_large, n_squarings) += 1.;
          where(is_large, factor) *= 0.5;
        }
      scale<dim>(x, factor);

      Element result = taylor<dim>(x);
      for (int n = 0; any_of(n_squarings > n); ++n)
        replace<dim>(n_squarings > n, result, product<dim>(result, result));
      return result;
    }
  } // namespace



  template <int dim>
  Tensors<dim>
  exponential(const Tensors<dim> &s)
  {
    return scale_and_square<dim>(s, taylor_norm, s);
  }



  template <int dim>
  ValueAndDerivative<dim>
  exponential(const Tensors<dim> &s, const Tensors<dim> &direction)
  {
    return scale_and_square<dim>(s,
                                 taylor_norm / 2.,
                                 ValueAndDerivative<dim>{s, direction});
  }



  template SymmetricTensor<2, 2, Pack>
  exponential(const SymmetricTensor<2, 2, Pack> &);
  template ValueAndDerivative<2>
  exponential(const SymmetricTensor<2, 2, Pack> &,
              const SymmetricTensor<2, 2, Pack> &);
  template SymmetricTensor<2, 3, Pack>
  exponential(const SymmetricTensor<2, 3, Pack> &);
  template ValueAndDerivative<3>
  exponential(const SymmetricTensor<2, 3, Pack> &,
              const SymmetricTensor<2, 3, Pack> &);
} // namespace Catena

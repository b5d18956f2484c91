#ifndef catena_rheology_giesekus_h
#define catena_rheology_giesekus_h

#include <catena/rheology/spectral.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace Catena
{
  /**
   * The dimensionless groups of a Giesekus fluid. With lengths in a, rates in
   * gamma and viscosities in eta0 = eta_s + eta_p they fix all of its
   * material constants.
   */
  struct GiesekusParameters
  {
    /// Wi = lambda gamma, the relaxation time in units of 1/gamma; Wi > 0.
    double weissenberg_number = 1.;

    /// alpha, 0 <= alpha <= 1; alpha = 0 is the Oldroyd-B fluid.
    double mobility_parameter = 0.1;

    /// beta = eta_s/eta0, 0 <= beta < 1; beta = 0 is a fluid without solvent.
    double solvent_viscosity_ratio = 0.1;

    /**
     * Declare the entries "Weissenberg number", "Mobility parameter" and
     * "Solvent viscosity ratio" in the current section of @p prm. Parsing
     * @p prm fills this object, which must outlive @p prm.
     */
    void
    declare(dealii::ParameterHandler &prm);

    /**
     * @throws InputError if a parameter is outside its range.
     */
    void
    check() const;
  };

  /**
   * L c + c L^T, the rate at which a velocity gradient @p L stretches and turns
   * the tensor @p c.
   */
  template <int dim, typename Number>
  inline dealii::SymmetricTensor<2, dim, Number>
  stretching_rate(const dealii::Tensor<2, dim, Number>          &L,
                  const dealii::SymmetricTensor<2, dim, Number> &c)
  {
    dealii::SymmetricTensor<2, dim, Number> rate;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          rate[i][j] += L[i][k] * c[k][j] + c[i][k] * L[j][k];
    return rate;
  }



  /**
   * The Giesekus model (H. Giesekus, J. Non-Newtonian Fluid Mech. 11 (1982)
   * 69) at a material point, for the conformation c and for its logarithm
   * s = log(c). The polymer stress is tau = G (c - I) and
   * @f[
   *   \frac{Dc}{Dt} = L c + c L^T + f(c), \qquad
   *   f(c) = -\frac{1}{\lambda} \left[ (c - I) + \alpha (c - I)^2 \right],
   * @f]
   * where L_ij = du_i/dx_j is the velocity gradient. Times are in units of
   * 1/gamma, stresses and moduli in units of eta0 gamma. Functions of a @p
   * Number are for one point or, with a Pack, for some at once.
   *
   * For dim = 2 the flow is plane: c_zz = 1 and does not enter.
   */
  template <int dim>
  class Giesekus
  {
  public:
    /**
     * @throws InputError as GiesekusParameters::check() does.
     */
    explicit Giesekus(const GiesekusParameters &parameters);

    /// lambda = Wi, in units of 1/gamma.
    double
    relaxation_time() const;

    /// G = (1 - beta)/lambda, in units of eta0 gamma.
    double
    modulus() const;

    /// eta_s = beta, in units of eta0.
    double
    solvent_viscosity() const;

    /**
     * The relaxation f(c) of the conformation @p c, in units of gamma.
     */
    template <typename Number>
    dealii::SymmetricTensor<2, dim, Number>
    relaxation(const dealii::SymmetricTensor<2, dim, Number> &c) const;

    /**
     * Dc/Dt = L c + c L^T + f(c) following a material point, for the velocity
     * gradient @p L and the conformation @p c; in units of gamma.
     */
    template <typename Number>
    dealii::SymmetricTensor<2, dim, Number>
    conformation_rate(const dealii::Tensor<2, dim, Number>          &L,
                      const dealii::SymmetricTensor<2, dim, Number> &c) const;

    /**
     * g(L, s) = Ds/Dt following a material point, for the velocity gradient
     * @p L and the tensor s = log(c) decomposed in @p d; in units of gamma.
     *
     * It is logarithm_derivative() applied to conformation_rate(). With R the
     * eigenvectors of s, L~ = R^T L R and x = (s_i - s_j)/2, its components
     * in the principal frame are (Fattal & Kupferman, J. Non-Newtonian Fluid
     * Mech. 123 (2004) 281; Hulsen, Fattal & Kupferman, J. Non-Newtonian
     * Fluid Mech. 127 (2005) 27, section 2)
     * @f[
     *   \tilde g_{ij} = \frac{x}{\sinh x}
     *     \left( \tilde L_{ij} e^{-x} + \tilde L_{ji} e^{x} \right)
     *     - \frac{\delta_{ij}}{\lambda} \left[ (1 - e^{-s_i})
     *     + \alpha (e^{s_i} - 2 + e^{-s_i}) \right].
     * @f]
     * No term loses digits for equal or nearly equal eigenvalues, nor near
     * s = 0.
     */
    template <typename Number>
    dealii::SymmetricTensor<2, dim, Number>
    log_conformation_rate(const dealii::Tensor<2, dim, Number>     &L,
                          const SpectralDecomposition<dim, Number> &d) const;

    /**
     * The largest rate at which a small change of s = log(c) relaxes, by the
     * derivative of the relaxation in g(L, s) by the eigenvalues of s,
     * @f$ \max_i \left( (1-\alpha) e^{-s_i} + \alpha e^{s_i} \right) /
     * \lambda @f$; in units of gamma.
     */
    template <typename Number>
    Number
    fastest_relaxation(const SpectralDecomposition<dim, Number> &d) const;

    /**
     * The time in which the conformation changes in the velocity gradient
     * @p L and in an element that is crossed at the rate r = @p crossing,
     * @f$ ((1/\lambda + |L|)^2 + r^2)^{-1/2} @f$; in units of 1/gamma.
     */
    template <typename Number>
    Number
    time_of_change(const dealii::Tensor<2, dim, Number> &L,
                   const Number                         &crossing) const;

    /**
     * The polymer stress tau = G (c - I), in units of eta0 gamma.
     */
    dealii::SymmetricTensor<2, dim>
    stress(const dealii::SymmetricTensor<2, dim> &c) const;

  private:
    double lambda;
    double alpha;
    double beta;
  };



  // ---------------------------- inline functions ----------------------------

  template <int dim>
  inline double
  Giesekus<dim>::relaxation_time() const
  {
    return lambda;
  }



  template <int dim>
  inline double
  Giesekus<dim>::modulus() const
  {
    return (1. - beta) / lambda;
  }



  template <int dim>
  inline double
  Giesekus<dim>::solvent_viscosity() const
  {
    return beta;
  }



  template <int dim>
  template <typename Number>
  inline dealii::SymmetricTensor<2, dim, Number>
  Giesekus<dim>::relaxation(
    const dealii::SymmetricTensor<2, dim, Number> &c) const
  {
    const dealii::SymmetricTensor<2, dim, Number> departure =
      c - dealii::unit_symmetric_tensor<dim, Number>();

    dealii::SymmetricTensor<2, dim, Number> f;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          Number square = 0.;
          for (unsigned int k = 0; k < dim; ++k)
            square += departure[i][k] * departure[k][j];
          f[i][j] = -(departure[i][j] + alpha * square) / lambda;
        }
    return f;
  }



  template <int dim>
  template <typename Number>
  inline dealii::SymmetricTensor<2, dim, Number>
  Giesekus<dim>::conformation_rate(
    const dealii::Tensor<2, dim, Number>          &L,
    const dealii::SymmetricTensor<2, dim, Number> &c) const
  {
    return stretching_rate(L, c) + relaxation(c);
  }



  template <int dim>
  template <typename Number>
  inline dealii::SymmetricTensor<2, dim, Number>
  Giesekus<dim>::log_conformation_rate(
    const dealii::Tensor<2, dim, Number>     &L,
    const SpectralDecomposition<dim, Number> &d) const
  {
    using std::abs;
    using std::expm1;
    using std::sqrt;
    const dealii::Tensor<2, dim, Number> l = to_frame(L, d.vectors);

    dealii::Tensor<2, dim, Number> g;
    std::array<Number, dim>        root; // e^{s_i/2}
    for (unsigned int i = 0; i < dim; ++i)
      {
        // With m = e^{|s|} - 1 nothing cancels: 1 - e^{-s} = m/(1 + m) for
        // s > 0 and -m for s < 0, e^s - 2 + e^{-s} = m^2/(1 + m).
        const Number s            = d.values[i];
        const Number m            = expm1(abs(s));
        const Number quotient     = m / (1. + m);
        const Number larger       = sqrt(1. + m);
        const auto   is_stretched = s > 0.;

        root[i] = select(is_stretched, larger, 1. / larger);
        g[i][i] =
          2. * l[i][i] -
          (select(is_stretched, quotient, -m) + alpha * m * quotient) / lambda;
      }

    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i + 1; j < dim; ++j)
        {
          const Number x        = 0.5 * (d.values[i] - d.values[j]);
          const Number e        = root[i] / root[j]; // e^x
          const Number inverse  = root[j] / root[i];
          const auto   is_small = abs(x) <= 0.5;
          const Number quotient =
            select(is_small,
                   1. / sinh_quotient_series(x),
                   2. * x / select(is_small, Number(1.), e - inverse));
          g[i][j] = quotient * (l[i][j] * inverse + l[j][i] * e);
        }
    return from_frame(g, d.vectors);
  }



  template <int dim>
  template <typename Number>
  inline Number
  Giesekus<dim>::fastest_relaxation(
    const SpectralDecomposition<dim, Number> &d) const
  {
    using std::exp;
    using std::max;
    Number rate = 0.;
    for (const Number &s : d.values)
      {
        const Number c = exp(s);
        rate           = max(rate, (1. - alpha) / c + alpha * c);
      }
    return rate / lambda;
  }



  template <int dim>
  template <typename Number>
  inline Number
  Giesekus<dim>::time_of_change(const dealii::Tensor<2, dim, Number> &L,
                                const Number &crossing) const
  {
    using std::sqrt;
    const Number rate = 1. / lambda + frobenius_norm(L);
    return 1. / sqrt(rate * rate + crossing * crossing);
  }



  template <int dim>
  inline dealii::SymmetricTensor<2, dim>
  Giesekus<dim>::stress(const dealii::SymmetricTensor<2, dim> &c) const
  {
    return modulus() * (c - dealii::unit_symmetric_tensor<dim, double>());
  }
} // namespace Catena

#endif

// The spectral decomposition is orthogonal, recomposes the tensor and gives
// its eigenvalues to a few roundings, however close or far apart they are.

#include <catena/rheology/spectral.h>

#include "../tests.h"

#include "multiprecision.h"

template <int dim>
void
test(Catena::Tests::Claims &claims)
{
  using namespace Catena;

  std::mt19937 generator(dim);
  double       recomposition = 0., orthogonality = 0., eigenvalues = 0.;
  for (const auto &s : Reference::hard_cases<dim>(generator))
    {
      const SpectralDecomposition<dim> d     = spectral_decomposition(s);
      const auto                       exact = Reference::to_matrix<dim>(s);
      const Reference::Number          scale = Reference::norm(exact) + 1e-300;

      recomposition =
        std::max(recomposition, Reference::roundings(compose(d), exact, scale));

      orthogonality =
        std::max(orthogonality,
                 Reference::roundings(dealii::transpose(d.vectors) * d.vectors,
                                      Reference::identity<dim>(),
                                      1));

      auto values   = d.values;
      auto expected = Reference::eigen<dim>(exact).first;
      std::sort(values.begin(), values.end());
      std::sort(expected.begin(), expected.end());
      for (unsigned int i = 0; i < dim; ++i)
        {
          const Reference::Number error = abs(values[i] - expected[i]) / scale;
          eigenvalues =
            std::max(eigenvalues, static_cast<double>(error) / 2.2e-16);
        }
    }

  const std::string name = "dim " + std::to_string(dim) + ", ";
  claims.at_most(name + "the tensor is recomposed", recomposition, 16.);
  claims.at_most(name + "eigenvectors are orthonormal", orthogonality, 16.);
  claims.at_most(name + "eigenvalues are exact", eigenvalues, 8.);

  // Rows of very different size, as in strong shear: c = D A D.
  double relative = 0.;
  for (unsigned int n = 0; n < 100; ++n)
    {
      dealii::SymmetricTensor<2, dim> c = dealii::unit_symmetric_tensor<dim>();
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          c[i][j] = std::uniform_real_distribution<>(-0.4, 0.4)(generator);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          c[i][j] *= std::pow(10., -3. * ((i + n) % dim + (j + n) % dim));

      auto values   = spectral_decomposition(c).values;
      auto expected = Reference::eigen<dim>(Reference::to_matrix<dim>(c)).first;
      std::sort(values.begin(), values.end());
      std::sort(expected.begin(), expected.end());
      for (unsigned int i = 0; i < dim; ++i)
        {
          const Reference::Number error = abs(values[i] / expected[i] - 1);
          relative = std::max(relative, static_cast<double>(error) / 2.2e-16);
        }
    }
  claims.at_most(name + "small eigenvalues of graded tensors are exact",
                 relative,
                 16.);
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    test<2>(claims);
    test<3>(claims);
  });
}

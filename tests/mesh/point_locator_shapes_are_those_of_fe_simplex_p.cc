// The quadratic shape functions are those of FE_SimplexP(2), in its order.

#include <catena/mesh/quadratic_shape.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <random>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

template <int dim>
void
compare(Tests::Claims &claims)
{
  const FE_SimplexP<dim>                 fe(2);
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> uniform(-0.1, 1.);

  double value_error = 0., gradient_error = 0.;
  for (unsigned int n = 0; n < 50; ++n)
    {
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = uniform(generator);
      const auto values    = quadratic_shape_values(p);
      const auto gradients = quadratic_shape_gradients(p);
      for (unsigned int i = 0; i < values.size(); ++i)
        {
          value_error =
            std::max(value_error, std::abs(values[i] - fe.shape_value(i, p)));
          gradient_error =
            std::max(gradient_error,
                     (gradients[i] - fe.shape_grad(i, p)).norm());
        }
    }

  const std::string in = " in " + std::to_string(dim) + "D";
  claims.at_most("values are those of FE_SimplexP(2)" + in, value_error, 1e-13);
  claims.at_most("gradients are those of FE_SimplexP(2)" + in,
                 gradient_error,
                 1e-13);
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    compare<2>(claims);
    compare<3>(claims);
  });
}

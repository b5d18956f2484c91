// The packs of a cell hold the linear shape functions and fields of its points,
// and lanes beyond the last point count for nothing.

#include <catena/mesh/cell_fields.h>
#include <catena/mesh/quadratic_shape.h>

#include <random>

#include "../tests.h"

template <int dim>
void
test(Catena::Tests::Claims &claims, const bool curved)
{
  using namespace Catena;
  using dealii::Point;
  using dealii::Tensor;

  std::mt19937                     generator(dim);
  std::normal_distribution<double> normal;

  // the reference cell, moved a little
  typename CellValues<dim>::NodePositions positions;
  for (unsigned int d = 0; d < dim; ++d)
    positions[d + 1][d] = 1.;
  for (unsigned int a = 0; a < dim + 1; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      positions[a][d] += 0.05 * normal(generator);
  for (unsigned int a = dim + 1; a < positions.size(); ++a)
    {
      const auto ends = simplex_edge(a - dim - 1);
      positions[a] =
        positions[ends[0]] + (positions[ends[1]] - positions[ends[0]]) / 2.;
      if (curved)
        positions[a][0] += 0.02;
    }

  NodeVectors<dim> field;
  for (unsigned int a = 0; a < positions.size(); ++a)
    for (unsigned int d = 0; d < dim; ++d)
      field.components[d].set(a, normal(generator));
  std::array<dealii::SymmetricTensor<2, dim>, dim + 1> tensors;
  for (auto &tensor : tensors)
    for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
      tensor.access_raw_entry(k) = normal(generator);

  CellValues<dim> values;
  values.reinit(positions, curved);
  double       volume = 0., volume_of_packs = 0., error = 0.;
  unsigned int n_points = 0;
  for (const auto &point : values.points())
    volume += point.JxW;
  for (const auto &pack : values.packs())
    {
      volume_of_packs += reduce(pack.JxW);
      n_points += pack.n_points;

      const auto w       = values_at<dim>(values, pack, field);
      const auto L       = gradients_at<dim>(values, pack, field);
      const auto s       = interpolate<dim>(pack, tensors);
      const auto s_along = derivative_along<dim>(pack, w, tensors);
      const Pack rate    = crossing_rate<dim>(pack, w);
      for (unsigned int k = 0; k < pack.n_points; ++k)
        {
          const auto    &point = values.points()[pack.first + k];
          Tensor<1, dim> w_k;
          Tensor<2, dim> L_k;
          dealii::SymmetricTensor<2, dim> s_k, s_along_k;
          double                          rate_k = 0.;
          for (unsigned int a = 0; a < positions.size(); ++a)
            {
              w_k += point.quadratic[a] * field[a];
              L_k += outer_product(field[a], point.quadratic_gradient[a]);
            }
          for (unsigned int v = 0; v < dim + 1; ++v)
            {
              const double along = w_k * point.linear_gradient[v];
              s_k += point.linear[v] * tensors[v];
              s_along_k += along * tensors[v];
              rate_k += std::abs(along);
            }
          for (unsigned int i = 0; i < dim; ++i)
            {
              error = std::max(error, std::abs(w[i][k] - w_k[i]));
              for (unsigned int j = 0; j < dim; ++j)
                error = std::max(error, std::abs(L[i][j][k] - L_k[i][j]));
            }
          error = std::max({error,
                            (lane(s, k) - s_k).norm(),
                            (lane(s_along, k) - s_along_k).norm(),
                            std::abs(rate[k] - rate_k)});
        }
    }

  const std::string name =
    "dim " + std::to_string(dim) + (curved ? ", curved, " : ", straight, ");
  claims.holds(name + "every point is in a pack",
               n_points == values.points().size());
  claims.near(name + "other lanes have no volume",
              volume_of_packs,
              volume,
              1e-15);
  claims.at_most(name + "fields are those of the points", error, 1e-13);
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    for (const bool curved : {false, true})
      {
        test<2>(claims, curved);
        test<3>(claims, curved);
      }
  });
}

#include <catena/mesh/cell_values.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  void
  CellValues<dim>::Rule::tabulate(const Quadrature<dim> &quadrature)
  {
    // takes longer to make than some assemblies last
    static const FE_SimplexP<dim> quadratic(2), linear(1);
    reference.resize(quadrature.size());
    values.resize(quadrature.size());
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const Point<dim> &p = quadrature.point(q);
        reference[q].weight = quadrature.weight(q);
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            values[q].quadratic.set(i, quadratic.shape_value(i, p));
            reference[q].quadratic_gradient.set(i, quadratic.shape_grad(i, p));
          }
        for (unsigned int i = 0; i < n_vertices; ++i)
          {
            values[q].linear[i]             = linear.shape_value(i, p);
            reference[q].linear_gradient[i] = linear.shape_grad(i, p);
          }
      }

    packs.resize((values.size() + pack_size - 1) / pack_size);
    for (unsigned int k = 0; k < packs.size(); ++k)
      {
        PackValues &pack = packs[k];
        pack.first       = k * pack_size;
        pack.n_points =
          std::min<unsigned int>(pack_size, values.size() - pack.first);
        for (unsigned int lane = 0; lane < pack_size; ++lane)
          for (unsigned int v = 0; v < n_vertices; ++v)
            pack.linear[v][lane] = point(pack, lane).linear[v];
      }
  }



  /// What depends on the cell. Straight cells have the same gradients
  /// everywhere.
  template <int dim>
  void
  CellValues<dim>::Rule::update_packs(const bool curved)
  {
    for (PackValues &pack : packs)
      {
        pack.JxW = Pack([&](const unsigned int lane) {
          return lane < pack.n_points ? point(pack, lane).JxW : 0.;
        });
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            pack.linear_gradient[v][d] =
              curved ? Pack([&](const unsigned int lane) {
                return point(pack, lane).linear_gradient[v][d];
              }) :
                       Pack(values[0].linear_gradient[v][d]);
      }
  }



  template <int dim>
  Quadrature<dim>
  CellValues<dim>::rule(const bool curved)
  {
    if (curved)
      return QWitherdenVincentSimplex<dim>(3);
    return QGaussSimplex<dim>(2);
  }



  template <int dim>
  CellValues<dim>::CellValues()
  {
    straight_rule.tabulate(rule(false));
    curved_rule.tabulate(rule(true));
  }



  template <int dim>
  CellValues<dim>::CellValues(const Quadrature<dim> &quadrature)
  {
    straight_rule.tabulate(quadrature);
    curved_rule.tabulate(quadrature);
  }



  template <int dim>
  void
  CellValues<dim>::reinit(const NodePositions &positions, const bool curved)
  {
    Rule &rule = curved ? curved_rule : straight_rule;
    active     = &rule;

    NodeVectors<dim> nodes;
    if (curved)
      for (unsigned int i = 0; i < n_nodes; ++i)
        nodes.set(i, positions[i]);

    Tensor<2, dim> inverse_transposed;
    double         determinant_j = 0.;
    for (unsigned int q = 0; q < rule.values.size(); ++q)
      {
        const ReferencePoint &reference = rule.reference[q];
        if (curved || q == 0)
          {
            Tensor<2, dim> jacobian;
            if (curved)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  jacobian[i][j] = nodes.components[i] *
                                   reference.quadratic_gradient.components[j];
            else
              for (unsigned int i = 0; i < n_vertices; ++i)
                jacobian += outer_product(Tensor<1, dim>(positions[i]),
                                          reference.linear_gradient[i]);
            determinant_j      = determinant(jacobian);
            inverse_transposed = transpose(invert(jacobian));
          }

        PointValues &values       = rule.values[q];
        values.JxW                = reference.weight * determinant_j;
        values.quadratic_gradient = {};
        values.quadratic_gradient.add_product(inverse_transposed,
                                              reference.quadratic_gradient);
        if (curved || q == 0)
          for (unsigned int i = 0; i < n_vertices; ++i)
            values.linear_gradient[i] =
              inverse_transposed * reference.linear_gradient[i];
        else
          values.linear_gradient = rule.values[0].linear_gradient;
      }
    rule.update_packs(curved);
  }



  template class CellValues<2>;
  template class CellValues<3>;
} // namespace Catena

#include <catena/mesh/cell_values.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_simplex_p.h>

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
            values[q].quadratic[i]             = quadratic.shape_value(i, p);
            reference[q].quadratic_gradient[i] = quadratic.shape_grad(i, p);
          }
        for (unsigned int i = 0; i < n_vertices; ++i)
          {
            values[q].linear[i]             = linear.shape_value(i, p);
            reference[q].linear_gradient[i] = linear.shape_grad(i, p);
          }
      }
  }



  template <int dim>
  CellValues<dim>::CellValues()
  {
    straight_rule.tabulate(QGaussSimplex<dim>(2));
    curved_rule.tabulate(QWitherdenVincentSimplex<dim>(3));
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
    active     = &rule.values;

    Tensor<2, dim> inverse_transposed;
    double         determinant_j = 0.;
    for (unsigned int q = 0; q < rule.values.size(); ++q)
      {
        const ReferencePoint &reference = rule.reference[q];
        if (curved || q == 0)
          {
            Tensor<2, dim> jacobian;
            if (curved)
              for (unsigned int i = 0; i < n_nodes; ++i)
                jacobian += outer_product(Tensor<1, dim>(positions[i]),
                                          reference.quadratic_gradient[i]);
            else
              for (unsigned int i = 0; i < n_vertices; ++i)
                jacobian += outer_product(Tensor<1, dim>(positions[i]),
                                          reference.linear_gradient[i]);
            determinant_j      = determinant(jacobian);
            inverse_transposed = transpose(invert(jacobian));
          }

        PointValues &values = rule.values[q];
        values.JxW          = reference.weight * determinant_j;
        for (unsigned int i = 0; i < n_nodes; ++i)
          values.quadratic_gradient[i] =
            inverse_transposed * reference.quadratic_gradient[i];
        if (curved || q == 0)
          for (unsigned int i = 0; i < n_vertices; ++i)
            values.linear_gradient[i] =
              inverse_transposed * reference.linear_gradient[i];
        else
          values.linear_gradient = rule.values[0].linear_gradient;
      }
  }



  template class CellValues<2>;
  template class CellValues<3>;
} // namespace Catena

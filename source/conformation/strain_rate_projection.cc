#include <catena/base/exceptions.h>
#include <catena/conformation/strain_rate_projection.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/cell_values.h>

#include <deal.II/lac/solver_cg.h>

namespace Catena
{
  using namespace dealii;

  /**
   * The mass matrix of the free values.
   */
  template <int dim>
  class StrainRateProjection<dim>::Mass
  {
  public:
    explicit Mass(const StrainRateProjection &projection)
      : projection(projection)
    {}

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const
    {
      const auto fields =
        projection.identification.fields(projection.mesh, src);
      dst = 0.;
      for (unsigned int c = 0; c < projection.masses.size(); ++c)
        {
          const auto     &cell   = projection.mesh.cells()[c];
          const auto      values = vertex_tensors<dim>(cell, fields);
          const CellMass &mass   = projection.masses[c];
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              SymmetricTensor<2, dim> sum;
              for (unsigned int w = 0; w < n_vertices; ++w)
                sum += mass[v][w] * values[w];
              projection.add(dst, cell.vertices[v], sum);
            }
        }
    }

    BlockVectorType
    inverse_diagonal() const
    {
      BlockVectorType diagonal =
        TensorIdentification<dim>::zero(projection.mesh);
      for (unsigned int c = 0; c < projection.masses.size(); ++c)
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            const unsigned int vertex = projection.mesh.cells()[c].vertices[v];
            const unsigned int master =
              projection.identification.master(vertex);
            if (projection.mesh.owned_scalars().is_element(master))
              for (unsigned int k = 0; k < n_components; ++k)
                diagonal.block(k)(master) += projection.masses[c][v][v];
          }
      for (unsigned int k = 0; k < n_components; ++k)
        for (double &value : diagonal.block(k))
          value = value > 0. ? 1. / value : 1.;
      return diagonal;
    }

  private:
    const StrainRateProjection &projection;
  };



  template <int dim>
  StrainRateProjection<dim>::StrainRateProjection(const MovingMesh<dim> &mesh)
    : mesh(mesh)
    , identification(mesh)
  {
    CellValues<dim> values;
    for (const auto &cell : mesh.cells())
      {
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        CellMass mass{};
        for (const auto &point : values.points())
          for (unsigned int v = 0; v < n_vertices; ++v)
            for (unsigned int w = 0; w < n_vertices; ++w)
              mass[v][w] += point.JxW * point.linear[v] * point.linear[w];
        masses.push_back(mass);
      }
  }



  template <int dim>
  void
  StrainRateProjection<dim>::add(BlockVectorType               &equations,
                                 const unsigned int             vertex,
                                 const SymmetricTensor<2, dim> &value) const
  {
    const unsigned int master = identification.master(vertex);
    if (mesh.owned_scalars().is_element(master))
      for (unsigned int k = 0; k < n_components; ++k)
        equations.block(k)(master) +=
          identification.factor(k, vertex) * value.access_raw_entry(k);
  }



  template <int dim>
  std::vector<VectorType>
  StrainRateProjection<dim>::project(const VectorType &velocity) const
  {
    constexpr double       relative_residual = 1e-6;
    constexpr unsigned int max_iterations    = 100;

    BlockVectorType rhs      = TensorIdentification<dim>::zero(mesh),
                    solution = TensorIdentification<dim>::zero(mesh);
    CellValues<dim> values;
    for (const auto &cell : mesh.cells())
      {
        values.reinit(mesh.cell_positions(cell, mesh.positions()), cell.curved);
        const auto u = node_vectors<dim>(cell, velocity);
        std::array<SymmetricTensor<2, dim>, n_vertices> sums;
        for (const auto &point : values.points())
          {
            const auto D = symmetrize(gradient_at<dim>(point, u));
            for (unsigned int v = 0; v < n_vertices; ++v)
              sums[v] += point.JxW * point.linear[v] * D;
          }
        for (unsigned int v = 0; v < n_vertices; ++v)
          add(rhs, cell.vertices[v], sums[v]);
      }

    const Mass mass(*this);
    struct Scaling
    {
      const BlockVectorType factors;

      void
      vmult(BlockVectorType &dst, const BlockVectorType &src) const
      {
        dst = src;
        dst.scale(factors);
      }
    };
    SolverControl control(max_iterations, relative_residual * rhs.l2_norm());
    try
      {
        SolverCG<BlockVectorType>(control).solve(
          mass, solution, rhs, Scaling{mass.inverse_diagonal()});
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw SolverError("The projection of the rate of strain did not "
                          "converge in " +
                          std::to_string(max_iterations) + " iterations.");
      }
    return identification.fields(mesh, solution);
  }



  template class StrainRateProjection<2>;
  template class StrainRateProjection<3>;
} // namespace Catena

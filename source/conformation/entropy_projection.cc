#include <catena/base/exceptions.h>
#include <catena/conformation/entropy_projection.h>
#include <catena/mesh/cell_fields.h>
#include <catena/rheology/spectral.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// The tensor of which only component @p k is one; it is symmetric.
    template <int dim>
    SymmetricTensor<2, dim>
    basis_tensor(const unsigned int k)
    {
      SymmetricTensor<2, dim> e;
      e.access_raw_entry(k) = 1.;
      return e;
    }
  } // namespace



  /**
   * Applies the Hessian to free values.
   */
  template <int dim>
  class EntropyProjection<dim>::Hessian
  {
  public:
    explicit Hessian(const EntropyProjection &projection)
      : projection(projection)
    {}

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const
    {
      const auto &identification = projection.identification;
      const auto &mesh           = projection.mesh;
      const auto  fields =
        projection.identification.fields(projection.mesh, src);
      dst = 0.;
      for (unsigned int c = 0; c < mesh.cells().size(); ++c)
        {
          const auto &cell = mesh.cells()[c];
          const auto  s    = vertex_tensors<dim>(cell, fields);
          std::array<std::array<double, n_components>, n_vertices> sums{};
          for (std::size_t q = projection.first_points[c];
               q < projection.first_points[c + 1];
               ++q)
            {
              const QuadraturePoint  &point = projection.points[q];
              SymmetricTensor<2, dim> s_q;
              for (unsigned int v = 0; v < n_vertices; ++v)
                s_q += point.shapes[v] * s[v];
              for (unsigned int k = 0; k < n_components; ++k)
                {
                  double rate = 0.;
                  for (unsigned int l = 0; l < n_components; ++l)
                    rate += point.tangent[k][l] * s_q.access_raw_entry(l);
                  for (unsigned int v = 0; v < n_vertices; ++v)
                    sums[v][k] += point.shapes[v] * rate;
                }
            }
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              const unsigned int master =
                identification.master(cell.vertices[v]);
              if (mesh.owned_scalars().is_element(master))
                for (unsigned int k = 0; k < n_components; ++k)
                  dst.block(k)(master) +=
                    identification.factor(k, cell.vertices[v]) * sums[v][k];
            }
        }
    }

  private:
    const EntropyProjection &projection;
  };



  /**
   * The inverse of the Hessian's row sums, a block for each vertex.
   */
  template <int dim>
  class EntropyProjection<dim>::LumpedInverse
  {
  public:
    explicit LumpedInverse(const EntropyProjection &projection)
      : owned(projection.mesh.owned_scalars())
      , blocks(owned.n_elements(),
               FullMatrix<double>(n_components, n_components))
    {
      const auto &identification = projection.identification;
      const auto &cells          = projection.mesh.cells();
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            const unsigned int vertex = cells[c].vertices[v];
            const unsigned int master = identification.master(vertex);
            if (!owned.is_element(master))
              continue;
            FullMatrix<double> &block = blocks[owned.index_within_set(master)];
            for (std::size_t q = projection.first_points[c];
                 q < projection.first_points[c + 1];
                 ++q)
              for (unsigned int k = 0; k < n_components; ++k)
                for (unsigned int l = 0; l < n_components; ++l)
                  block(k, l) += identification.factor(k, vertex) *
                                 identification.factor(l, vertex) *
                                 projection.points[q].shapes[v] *
                                 projection.points[q].tangent[k][l];
          }
      for (FullMatrix<double> &block : blocks)
        {
          for (unsigned int k = 0; k < n_components; ++k)
            if (block(k, k) == 0.)
              block(k, k) = 1.;
          block.gauss_jordan();
        }
    }

    void
    vmult(BlockVectorType &dst, const BlockVectorType &src) const
    {
      unsigned int i = 0;
      for (const FullMatrix<double> &block : blocks)
        {
          for (unsigned int k = 0; k < n_components; ++k)
            {
              double value = 0.;
              for (unsigned int l = 0; l < n_components; ++l)
                value += block(k, l) * src.block(l).local_element(i);
              dst.block(k).local_element(i) = value;
            }
          ++i;
        }
    }

  private:
    const IndexSet                 &owned;
    std::vector<FullMatrix<double>> blocks;
  };



  template <int dim>
  EntropyProjection<dim>::EntropyProjection(const MovingMesh<dim> &mesh,
                                            const VectorType      &positions)
    : mesh(mesh)
    , identification(mesh)
  {
    CellValues<dim> values;
    for (const auto &cell : mesh.cells())
      {
        first_points.push_back(points.size());
        values.reinit(mesh.cell_positions(cell, positions), cell.curved);
        for (const auto &point : values.points())
          points.push_back({point.JxW, point.linear, Tangent()});
      }
    first_points.push_back(points.size());
  }



  template <int dim>
  double
  EntropyProjection<dim>::evaluate(const std::vector<VectorType> &s,
                                   const Tensors                 &conformation,
                                   BlockVectorType               *gradient)
  {
    double functional = 0.;
    if (gradient)
      *gradient = 0.;
    for (unsigned int c = 0; c < mesh.cells().size(); ++c)
      {
        const auto &cell   = mesh.cells()[c];
        const auto  values = vertex_tensors<dim>(cell, s);
        std::array<SymmetricTensor<2, dim>, n_vertices> excess;
        for (std::size_t q = first_points[c]; q < first_points[c + 1]; ++q)
          {
            QuadraturePoint        &point = points[q];
            SymmetricTensor<2, dim> s_q;
            for (unsigned int v = 0; v < n_vertices; ++v)
              s_q += point.shapes[v] * values[v];
            const auto spectrum = spectral_decomposition<dim>(s_q);
            const auto c_h      = exponential<dim>(spectrum);
            if (cell.owned)
              functional += point.JxW * (trace(c_h) - conformation[q] * s_q);
            if (!gradient)
              continue;
            for (unsigned int v = 0; v < n_vertices; ++v)
              excess[v] +=
                point.JxW * point.shapes[v] * (c_h - conformation[q]);
            for (unsigned int l = 0; l < n_components; ++l)
              {
                const auto derivative =
                  exponential_derivative<dim>(spectrum, basis_tensor<dim>(l));
                for (unsigned int k = 0; k < n_components; ++k)
                  point.tangent[k][l] =
                    point.JxW * (basis_tensor<dim>(k) * derivative);
              }
          }
        if (gradient)
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              const unsigned int master =
                identification.master(cell.vertices[v]);
              if (mesh.owned_scalars().is_element(master))
                for (unsigned int k = 0; k < n_components; ++k)
                  gradient->block(k)(master) +=
                    identification.factor(k, cell.vertices[v]) *
                    (basis_tensor<dim>(k) * excess[v]);
            }
      }
    return Utilities::MPI::sum(functional, mesh.communicator());
  }



  template <int dim>
  std::vector<VectorType>
  EntropyProjection<dim>::project(const Tensors                 &conformation,
                                  const std::vector<VectorType> &guess)
  {
    constexpr unsigned int max_steps     = 50;
    constexpr double       small_change  = 1e-2; // its square is left
    constexpr double       least_step    = 1e-4;
    constexpr double       linear_excess = 1e-3;

    BlockVectorType s        = TensorIdentification<dim>::zero(mesh),
                    gradient = TensorIdentification<dim>::zero(mesh),
                    change   = TensorIdentification<dim>::zero(mesh);
    for (unsigned int k = 0; k < n_components; ++k)
      for (const auto i : mesh.owned_scalars())
        if (identification.is_free(k, i))
          s.block(k)(i) = guess[k](i);

    for (unsigned int step = 0; step < max_steps; ++step)
      {
        const double functional =
          evaluate(identification.fields(mesh, s), conformation, &gradient);
        if (!std::isfinite(functional))
          throw SolverError(
            "The projection of the conformation onto a new mesh "
            "has values that are not finite.");
        change = 0.;
        SolverControl control(200, linear_excess * gradient.l2_norm());
        try
          {
            SolverCG<BlockVectorType>(control).solve(Hessian(*this),
                                                     change,
                                                     gradient,
                                                     LumpedInverse(*this));
          }
        catch (const SolverControl::NoConvergence &)
          {
            throw SolverError("A linear solve in the projection of the "
                              "conformation onto a new mesh did not converge.");
          }
        const double decrease = change * gradient;
        double       length   = 1.;
        s.add(-1., change);
        while (
          length > least_step &&
          !(evaluate(identification.fields(mesh, s), conformation, nullptr) <=
            functional - 0.1 * length * decrease +
              1e-12 * std::abs(functional)))
          {
            length /= 2.;
            s.add(length, change);
          }
        if (change.linfty_norm() < small_change)
          return identification.fields(mesh, s);
      }
    throw SolverError("The projection of the conformation onto a new mesh did "
                      "not converge in " +
                      std::to_string(max_steps) + " steps.");
  }



  template class EntropyProjection<2>;
  template class EntropyProjection<3>;
} // namespace Catena

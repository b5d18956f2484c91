#include <catena/base/exceptions.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/mesh_mover.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  MeshMover<dim>::MeshMover(const MovingMesh<dim>    &mesh,
                            const Configuration<dim> &reference)
    : mesh(mesh)
    , reference(reference)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::vector<signed char> factors(mesh.scalar_dofs().n_dofs());
        for (const auto vertex : mesh.relevant_scalars())
          factors[vertex] = factor(vertex, d);

        // components share a problem where all ranks agree
        const bool as_before =
          !problems.empty() && problems.back().factors == factors;
        if (Utilities::MPI::min(as_before ? 1 : 0, mesh.communicator()) == 0)
          {
            problems.emplace_back();
            problems.back().factors = factors;
          }
        problems.back().components.push_back(d);
        displacements[d] = mesh.scalar_field();
      }
    assemble();
  }



  template <int dim>
  signed char
  MeshMover<dim>::factor(const unsigned int vertex,
                         const unsigned int component) const
  {
    const unsigned int node = mesh.node_of_vertex(vertex);
    // without a particle there is nothing that fixes x
    const bool slides = component == 0 && !mesh.scene().particles.empty();
    if ((mesh.on_wall(node) && !slides) ||
        mesh.particle(node) != MovingMesh<dim>::no_particle ||
        (component == 2 && mesh.on_mirror(node)))
      return 0;
    return static_cast<signed char>(
      mesh.identification().vector_factor(node, component));
  }



  template <int dim>
  void
  MeshMover<dim>::assemble()
  {
    DynamicSparsityPattern pattern(mesh.scalar_dofs().n_dofs(),
                                   mesh.scalar_dofs().n_dofs(),
                                   mesh.relevant_scalars());
    for (const auto vertex : mesh.owned_scalars())
      pattern.add(vertex, vertex);
    for (const auto &cell : mesh.cells())
      for (const unsigned int i : cell.vertices)
        for (const unsigned int j : cell.vertices)
          {
            pattern.add(i, j);
            pattern.add(mesh.vertex_master(i), mesh.vertex_master(j));
          }
    const auto make_matrix = [&](TrilinosWrappers::SparseMatrix &matrix) {
      matrix.reinit(mesh.owned_scalars(),
                    mesh.owned_scalars(),
                    pattern,
                    mesh.communicator());
    };
    make_matrix(stiffness);
    for (Problem &problem : problems)
      make_matrix(problem.matrix);

    const MappingFE<dim>     straight(FE_SimplexP<dim>(1));
    const FE_SimplexP<dim>   element(1);
    const QGaussSimplex<dim> quadrature(1);
    FEValues<dim>            values(straight,
                         element,
                         quadrature,
                         update_gradients | update_JxW_values);
    const IndexSet          &owned = mesh.owned_scalars();
    for (const auto &cell : mesh.cells())
      {
        values.reinit(cell.iterator);
        const double weight = std::pow(values.JxW(0), 1. - 2. / dim);
        for (unsigned int a = 0; a < mesh.n_vertices; ++a)
          for (unsigned int b = 0; b < mesh.n_vertices; ++b)
            {
              const unsigned int i = cell.vertices[a], j = cell.vertices[b];
              const double       value =
                weight * (values.shape_grad(a, 0) * values.shape_grad(b, 0));
              if (owned.is_element(i))
                stiffness.add(i, j, value);
              if (owned.is_element(mesh.vertex_master(i)))
                for (Problem &problem : problems)
                  if (problem.factors[i] * problem.factors[j] != 0)
                    problem.matrix.add(mesh.vertex_master(i),
                                       mesh.vertex_master(j),
                                       problem.factors[i] * problem.factors[j] *
                                         value);
            }
      }
    stiffness.compress(VectorOperation::add);

    for (Problem &problem : problems)
      {
        problem.matrix.compress(VectorOperation::add);
        for (const auto vertex : owned)
          if (problem.matrix.diag_element(vertex) == 0.)
            problem.matrix.set(vertex, vertex, 1.);
        problem.matrix.compress(VectorOperation::insert);
        TrilinosWrappers::PreconditionAMG::AdditionalData data;
        data.elliptic              = true;
        data.aggregation_threshold = 1e-3;
        problem.preconditioner.initialize(problem.matrix, data);
      }
  }



  template <int dim>
  Tensor<1, dim>
  MeshMover<dim>::particle_displacement(
    const unsigned int        node,
    const Point<dim>         &point,
    const Configuration<dim> &configuration) const
  {
    const unsigned int   particle = mesh.particle(node);
    const Tensor<1, dim> arm      = mesh.arm(node, point, reference.centres);
    const double angle = configuration.frame_angle - reference.frame_angle;
    return mesh.particle_image(node).turn(
      configuration.centres[particle] - reference.centres[particle] +
      turned_about_z<dim>(arm, angle) - arm);
  }



  /**
   * Correct a displacement that has its prescribed values until the Laplace
   * equation holds at the free vertices.
   */
  template <int dim>
  void
  MeshMover<dim>::solve(const Problem     &problem,
                        const unsigned int component,
                        VectorType        &displacement) const
  {
    VectorType residual(mesh.owned_scalars(), mesh.communicator());
    VectorType solution(residual), owned_displacement(residual);
    owned_displacement.copy_locally_owned_data_from(displacement);
    stiffness.vmult(residual, owned_displacement);

    VectorType folded;
    folded.reinit(displacement);
    for (const auto vertex : mesh.owned_scalars())
      folded(mesh.vertex_master(vertex)) -=
        problem.factors[vertex] * residual(vertex);
    folded.compress(VectorOperation::add);
    for (const auto vertex : mesh.owned_scalars())
      residual(vertex) = problem.factors[vertex] == 0 ? 0. : folded(vertex);

    const double  tolerance = 1e-12 * stiffness.linfty_norm();
    SolverControl control(500, std::max(tolerance, 1e-10 * residual.l2_norm()));
    try
      {
        SolverCG<VectorType>(control).solve(problem.matrix,
                                            solution,
                                            residual,
                                            problem.preconditioner);
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw SolverError("The mesh motion of component " +
                          std::to_string(component) +
                          " did not converge in 500 iterations.");
      }

    VectorType correction = mesh.scalar_field();
    correction.copy_locally_owned_data_from(solution);
    correction.update_ghost_values();
    for (const auto vertex : mesh.owned_scalars())
      displacement(vertex) +=
        problem.factors[vertex] * correction(mesh.vertex_master(vertex));
  }



  template <int dim>
  VectorType
  MeshMover<dim>::positions(const Configuration<dim> &configuration) const
  {
    for (const Problem &problem : problems)
      for (const unsigned int d : problem.components)
        {
          VectorType &displacement = displacements[d];
          displacement.zero_out_ghost_values();
          for (const auto vertex : mesh.owned_scalars())
            {
              const unsigned int node = mesh.node_of_vertex(vertex);
              if (mesh.particle(node) == MovingMesh<dim>::no_particle)
                continue;
              const Point<dim> point =
                node_position<dim>(mesh.reference_positions(), node);
              displacement(vertex) =
                particle_displacement(node, point, configuration)[d];
            }
          solve(problem, d, displacement);
          displacement.update_ghost_values();
        }

    VectorType positions = mesh.vector_field();
    for (const auto node : mesh.owned_nodes())
      {
        const Point<dim> point =
          node_position<dim>(mesh.reference_positions(), node);
        Tensor<1, dim> displacement;
        if (mesh.particle(node) != MovingMesh<dim>::no_particle)
          displacement = particle_displacement(node, point, configuration);
        else
          for (const unsigned int end : mesh.edge_ends(node))
            for (unsigned int d = 0; d < dim; ++d)
              displacement[d] +=
                displacements[d](mesh.vertex_of_node(end)) / 2.;
        for (unsigned int d = 0; d < dim; ++d)
          positions(dim * node + d) = point[d] + displacement[d];
      }
    positions.update_ghost_values();
    return positions;
  }



  template <int dim>
  void
  MeshMover<dim>::archive(FieldArchive<dim> &archive)
  {
    for (VectorType &displacement : displacements)
      {
        if (archive.is_loading())
          displacement = VectorType();
        archive.scalar(displacement);
      }
  }



  template class MeshMover<2>;
  template class MeshMover<3>;
} // namespace Catena

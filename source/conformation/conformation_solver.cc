#include <catena/base/exceptions.h>
#include <catena/conformation/conformation_solver.h>
#include <catena/mesh/cell_fields.h>
#include <catena/mesh/cell_values.h>
#include <catena/rheology/spectral.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Rate at which the conformation turns in strong shear, in rates of shear.
    constexpr double turning_share = 0.1;

    /// @p known += the source at the points of @p pack.
    template <int dim>
    void
    add_source(const typename ConformationSolver<dim>::Source &source,
               const CellValues<dim>                          &values,
               const typename CellValues<dim>::PackValues     &pack,
               const typename CellValues<dim>::NodePositions  &positions,
               SymmetricTensor<2, dim, Pack>                  &known)
    {
      for (unsigned int lane = 0; lane < pack.n_points; ++lane)
        {
          const SymmetricTensor<2, dim> value = source(
            position_at<dim>(values.points()[pack.first + lane], positions));
          for (unsigned int k = 0; k < n_symmetric_components(dim); ++k)
            known.access_raw_entry(k)[lane] += value.access_raw_entry(k);
        }
    }
  } // namespace



  void
  ConformationSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Preconditioned residual of each component of the "
                      "log-conformation, relative to its right-hand side.",
                      Patterns::Double());
    prm.add_parameter("Maximal iterations",
                      max_iterations,
                      "Iterations after which a solve has failed.",
                      Patterns::Integer(0));
  }



  void
  ConformationSolverParameters::check() const
  {
    require(tolerance >= 1e-14 && tolerance < 1e-2,
            "Conformation solver/Tolerance",
            tolerance,
            "choose a value between 1e-14 and 1e-2");
    require(max_iterations >= 1 && max_iterations < 100000,
            "Conformation solver/Maximal iterations",
            max_iterations,
            "choose a positive number, 200 is usual");
  }



  template <int dim>
  ConformationSolver<dim>::ConformationSolver(
    const Giesekus<dim>                &model,
    const ConformationSolverParameters &parameters)
    : model(model)
    , parameters(parameters)
  {}



  template <int dim>
  void
  ConformationSolver<dim>::reinit(const MovingMesh<dim> &new_mesh)
  {
    mesh           = &new_mesh;
    identification = TensorIdentification<dim>(*mesh);

    DynamicSparsityPattern pattern(mesh->scalar_dofs().n_dofs(),
                                   mesh->scalar_dofs().n_dofs(),
                                   mesh->relevant_scalars());
    for (const auto vertex : mesh->owned_scalars())
      pattern.add(vertex, vertex);
    for (const auto &cell : mesh->cells())
      for (const unsigned int i : cell.vertices)
        for (const unsigned int j : cell.vertices)
          pattern.add(identification.master(i), identification.master(j));

    groups.clear();
    for (unsigned int k = 0; k < n_components; ++k)
      {
        const std::vector<signed char> &factors = identification.factors(k);
        Group                          *group   = nullptr;
        for (const auto &known : groups)
          if (Utilities::MPI::min(known->factors == factors ? 1 : 0,
                                  mesh->communicator()) == 1)
            group = known.get();
        if (group == nullptr)
          {
            groups.push_back(std::make_unique<Group>());
            group          = groups.back().get();
            group->factors = factors;
            group->matrix.reinit(mesh->owned_scalars(),
                                 mesh->owned_scalars(),
                                 pattern,
                                 mesh->communicator());
            group->access = CsrAccess(group->matrix,
                                      mesh->owned_scalars(),
                                      mesh->relevant_scalars());
          }
        group->components.push_back(k);
        group->rhs.emplace_back(mesh->owned_scalars(), mesh->communicator());
      }
    find_offsets();
  }



  template <int dim>
  void
  ConformationSolver<dim>::find_offsets()
  {
    const CsrAccess &access = groups.front()->access;
    offsets.assign(mesh->cells().size(), Offsets());
    for (unsigned int c = 0; c < offsets.size(); ++c)
      {
        const auto &vertices = mesh->cells()[c].vertices;
        for (unsigned int v = 0; v < vertices.size(); ++v)
          {
            const int row = access.row(identification.master(vertices[v]));
            if (row == CsrAccess::absent)
              continue;
            for (unsigned int u = 0; u < vertices.size(); ++u)
              offsets[c][v][u] = access.offset(
                row, access.column(identification.master(vertices[u])));
          }
      }
  }



  template <int dim>
  void
  ConformationSolver<dim>::assemble(const std::vector<VectorType> &old,
                                    const std::vector<VectorType> &older,
                                    const VectorType              &velocity,
                                    const VectorType &mesh_velocity,
                                    const TimeStep   &step,
                                    const Source     &source)
  {
    constexpr unsigned int n_vertices    = MovingMesh<dim>::n_vertices;
    const BdfCoefficients  bdf           = step.bdf();
    const TwoLevelWeights  extrapolation = step.extrapolation();

    for (const auto &group : groups)
      {
        group->matrix = 0.;
        for (VectorType &rhs : group->rhs)
          rhs = 0.;
      }

    CellValues<dim> values;
    for (unsigned int c = 0; c < mesh->cells().size(); ++c)
      {
        const auto &cell      = mesh->cells()[c];
        const auto  positions = mesh->cell_positions(cell, mesh->positions());
        values.reinit(positions, cell.curved);
        const auto s            = vertex_tensors<dim>(cell, old);
        const auto s_old        = vertex_tensors<dim>(cell, older);
        const auto u            = node_vectors<dim>(cell, velocity);
        auto       against_mesh = u;
        against_mesh.add(-1., node_vectors<dim>(cell, mesh_velocity));

        auto s_extrapolated = s, s_history = s;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            s_extrapolated[v] =
              extrapolation.b0 * s[v] + extrapolation.b1 * s_old[v];
            s_history[v] =
              (-1. / step.dt) * (bdf.a1 * s[v] + bdf.a2 * s_old[v]);
          }

        std::array<std::array<Pack, n_vertices>, n_vertices>  matrix_packs{};
        std::array<SymmetricTensor<2, dim, Pack>, n_vertices> rhs_packs;
        for (const auto &pack : values.packs())
          {
            const auto w        = values_at<dim>(values, pack, against_mesh);
            const auto L        = gradients_at<dim>(values, pack, u);
            const auto s_hat    = interpolate<dim>(pack, s_extrapolated);
            const auto spectrum = spectral_decomposition(s_hat);

            const Pack relaxation =
              max(Pack(0.),
                  model.fastest_relaxation(spectrum) +
                    turning_share * frobenius_norm(L) - 1. / step.dt);
            auto known = interpolate<dim>(pack, s_history) +
                         model.log_conformation_rate(L, spectrum) +
                         relaxation * s_hat;
            if (source)
              add_source(source, values, pack, positions, known);

            std::array<Pack, n_vertices> along_w;
            for (unsigned int v = 0; v < n_vertices; ++v)
              along_w[v] = w * pack.linear_gradient[v];
            const Pack tau =
              model.time_of_change(L, crossing_rate<dim>(pack, w));
            const Pack rate = bdf.a0 / step.dt + relaxation;

            for (unsigned int v = 0; v < n_vertices; ++v)
              {
                const Pack test =
                  pack.JxW * (pack.linear[v] + tau * along_w[v]);
                rhs_packs[v] += test * known;
                for (unsigned int u = 0; u < n_vertices; ++u)
                  matrix_packs[v][u] +=
                    test * (rate * pack.linear[u] + along_w[u]);
              }
          }

        std::array<std::array<double, n_vertices>, n_vertices> matrix;
        std::array<SymmetricTensor<2, dim>, n_vertices>        rhs;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            for (unsigned int u = 0; u < n_vertices; ++u)
              matrix[v][u] = reduce(matrix_packs[v][u]);
            for (unsigned int k = 0; k < n_components; ++k)
              rhs[v].access_raw_entry(k) =
                reduce(rhs_packs[v].access_raw_entry(k));
          }

        for (const auto &group : groups)
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              const unsigned int i      = cell.vertices[v];
              const unsigned int master = identification.master(i);
              const double       factor = group->factors[i];
              const int          row    = group->access.row(master);
              if (factor == 0. || row == CsrAccess::absent)
                continue;
              for (unsigned int k = 0; k < group->components.size(); ++k)
                group->rhs[k](master) +=
                  factor * rhs[v].access_raw_entry(group->components[k]);
              double *const entries = group->access.values(row);
              for (unsigned int u = 0; u < n_vertices; ++u)
                entries[offsets[c][v][u]] +=
                  factor * group->factors[cell.vertices[u]] * matrix[v][u];
            }
      }

    for (const auto &group : groups)
      for (const auto i : mesh->owned_scalars())
        {
          const int row = group->access.row(i);
          if (!identification.is_free(group->components[0], i))
            group->access.add(row, group->access.column(i), 1.);
          // vertices of small cells count as much as those of large ones
          const double scaling =
            1. / group->access.values(
                   row)[group->access.offset(row, group->access.column(i))];
          group->access.scale(row, scaling);
          for (VectorType &rhs : group->rhs)
            rhs(i) *= scaling;
        }
  }



  template <int dim>
  unsigned int
  ConformationSolver<dim>::solve_group(const Group             &group,
                                       std::vector<VectorType> &solution) const
  {
    TrilinosWrappers::PreconditionILU preconditioner;
    preconditioner.initialize(group.matrix);

    unsigned int iterations = 0;
    for (unsigned int k = 0; k < group.components.size(); ++k)
      {
        VectorType &component = solution[group.components[k]];
        VectorType  x(group.rhs[k]);
        x.copy_locally_owned_data_from(component);
        for (const auto i : mesh->owned_scalars())
          if (!identification.is_free(group.components[k], i))
            x(i) = 0.;

        // a field at rest has no right-hand side to compare with
        const double  scale = std::max(group.rhs[k].l2_norm(), 1e-14);
        SolverControl control(parameters.max_iterations,
                              parameters.tolerance * scale);
        try
          {
            SolverGMRES<VectorType>(
              control, typename SolverGMRES<VectorType>::AdditionalData(60))
              .solve(group.matrix, x, group.rhs[k], preconditioner);
          }
        catch (const SolverControl::NoConvergence &)
          {
            throw SolverError(
              "The log-conformation did not converge in " +
              std::to_string(parameters.max_iterations) +
              " iterations: use a smaller time step or raise 'Conformation "
              "solver/Maximal iterations'.");
          }
        iterations = std::max(iterations, control.last_step());

        component = identification.field(group.components[k], *mesh, x);
      }
    return iterations;
  }



  template <int dim>
  unsigned int
  ConformationSolver<dim>::solve(std::vector<VectorType>       &solution,
                                 const std::vector<VectorType> &old,
                                 const std::vector<VectorType> &older,
                                 const VectorType              &velocity,
                                 const VectorType              &mesh_velocity,
                                 const TimeStep                &step,
                                 const Source                  &source)
  {
    assemble(old, older, velocity, mesh_velocity, step, source);
    unsigned int iterations = 0;
    for (const auto &group : groups)
      iterations = std::max(iterations, solve_group(*group, solution));
    return iterations;
  }



  template <int dim>
  ConformationExtremes
  conformation_extremes(const MovingMesh<dim>         &mesh,
                        const std::vector<VectorType> &log_conformation)
  {
    ConformationExtremes extremes;
    bool                 finite = true;
    for (const auto i : mesh.owned_scalars())
      {
        const auto spectrum =
          spectral_decomposition<dim>(vertex_tensor<dim>(i, log_conformation));
        double stretch = 0.;
        for (const double value : spectrum.values)
          {
            finite &= std::isfinite(value);
            extremes.smallest_eigenvalue =
              std::min(extremes.smallest_eigenvalue, std::exp(value));
            extremes.largest_log =
              std::max(extremes.largest_log, std::abs(value));
            stretch += std::expm1(value);
          }
        extremes.largest_trace = std::max(extremes.largest_trace, stretch);
      }
    if (Utilities::MPI::min(finite ? 1 : 0, mesh.communicator()) == 0)
      throw SolverError("The conformation has values that are not finite: use "
                        "a smaller time step or a finer mesh.");
    extremes.smallest_eigenvalue =
      Utilities::MPI::min(extremes.smallest_eigenvalue, mesh.communicator());
    extremes.largest_log =
      Utilities::MPI::max(extremes.largest_log, mesh.communicator());
    extremes.largest_trace =
      Utilities::MPI::max(extremes.largest_trace, mesh.communicator());
    return extremes;
  }



  template class ConformationSolver<2>;
  template class ConformationSolver<3>;
  template ConformationExtremes
  conformation_extremes<2>(const MovingMesh<2> &,
                           const std::vector<VectorType> &);
  template ConformationExtremes
  conformation_extremes<3>(const MovingMesh<3> &,
                           const std::vector<VectorType> &);
} // namespace Catena

#ifndef catena_conformation_conformation_solver_h
#define catena_conformation_conformation_solver_h

#include <catena/base/csr_access.h>
#include <catena/base/time_history.h>
#include <catena/base/types.h>
#include <catena/conformation/tensor_identification.h>
#include <catena/mesh/moving_mesh.h>
#include <catena/rheology/giesekus.h>

#include <deal.II/base/parameter_handler.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace Catena
{
  /**
   * Controls of the linear solver of the log-conformation.
   */
  struct ConformationSolverParameters
  {
    /// preconditioned residual against the right-hand side, both of rows
    /// scaled with their diagonal
    double       tolerance      = 1e-8;
    unsigned int max_iterations = 200;

    /// Declare the entries in the current subsection.
    void
    declare(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    check() const;
  };



  /**
   * One step of the log-conformation s = log(c) on a moving mesh
   * (Hulsen, Fattal & Kupferman, J. Non-Newtonian Fluid Mech. 127 (2005) 27),
   *
   *   (a0 s + a1 s^n + a2 s^(n-1))/dt + w.grad s = g(L, s^) - k (s - s^),
   *
   * with w = u - u_mesh, L the gradient of the new velocity, s^ the
   * extrapolation from the last two levels, g the rate of
   * Giesekus::log_conformation_rate(), and k = max(0, r - 1/dt), mostly nothing,
   * with r = Giesekus::fastest_relaxation() + |L|/10. Where the conformation only
   * relaxes, the explicit g(L, s^) alone is stable for rates up to 4/3 of 1/dt,
   * and with k for all; |L|/10 is about the rate at which it turns in strong
   * shear, and with k steps can be twice as long there. P1 elements;
   * streamline-upwind Petrov-Galerkin test functions
   *
   *   v + tau w.grad v
   *
   * with Giesekus::time_of_change() tau for the crossing rate 2|w|/h, h being
   * the element length along w. tau has the rates of the material and
   * not that of the step: the solution at a point of time would otherwise
   * depend on the steps that lead to it. The operator is the same for all
   * components, so those with the same signs on identified planes share one
   * matrix and one preconditioner.
   */
  template <int dim>
  class ConformationSolver
  {
  public:
    static constexpr unsigned int n_components = n_symmetric_components(dim);

    /// Source added to g at a point, for tests with manufactured solutions.
    using Source = std::function<dealii::SymmetricTensor<2, dim>(
      const dealii::Point<dim> &)>;

    ConformationSolver(const Giesekus<dim>                &model,
                       const ConformationSolverParameters &parameters);

    /// A new mesh, kept by reference.
    void
    reinit(const MovingMesh<dim> &mesh);

    /**
     * Solve for the new level at the mesh's current positions.
     *
     * @param solution components in the order of deal.II's SymmetricTensor;
     * its value is the first guess
     * @param old, older s at t^n and t^(n-1)
     * @param velocity, mesh_velocity at the new instant, P2
     * @return the largest number of iterations of a component
     * @throws SolverError
     */
    unsigned int
    solve(std::vector<VectorType>       &solution,
          const std::vector<VectorType> &old,
          const std::vector<VectorType> &older,
          const VectorType              &velocity,
          const VectorType              &mesh_velocity,
          const TimeStep                &step,
          const Source                  &source = Source());

  private:
    /// Components with the same factors at all vertices (0: value 0).
    struct Group
    {
      std::vector<unsigned int>              components;
      std::vector<signed char>               factors;
      dealii::TrilinosWrappers::SparseMatrix matrix;
      CsrAccess                              access;
      std::vector<VectorType>                rhs;
    };

    const Giesekus<dim>                 model;
    const ConformationSolverParameters  parameters;
    const MovingMesh<dim>              *mesh = nullptr;
    std::vector<std::unique_ptr<Group>> groups;
    TensorIdentification<dim>           identification;

    /// Where in their rows the entries of a cell's pairs of vertices are
    /// stored, in the matrix of any group.
    using Offsets = std::array<std::array<unsigned short, n_linear_nodes(dim)>,
                               n_linear_nodes(dim)>;
    /// by cell of the mesh
    std::vector<Offsets> offsets;

    void
    find_offsets();

    void
    assemble(const std::vector<VectorType> &old,
             const std::vector<VectorType> &older,
             const VectorType              &velocity,
             const VectorType              &mesh_velocity,
             const TimeStep                &step,
             const Source                  &source);

    unsigned int
    solve_group(const Group &group, std::vector<VectorType> &solution) const;
  };



  /**
   * How stretched a conformation field is, over all vertices.
   */
  struct ConformationExtremes
  {
    double smallest_eigenvalue = 1.; ///< of c, or 1, that at rest
    double largest_trace       = 0.; ///< tr(c - I) = tr(tau)/G
    double largest_log         = 0.; ///< largest |eigenvalue| of s = log(c)
  };

  /**
   * @throws SolverError if a value is not finite
   */
  template <int dim>
  ConformationExtremes
  conformation_extremes(const MovingMesh<dim>         &mesh,
                        const std::vector<VectorType> &log_conformation);
} // namespace Catena

#endif

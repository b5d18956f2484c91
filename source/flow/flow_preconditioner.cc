#include <catena/base/replicated.h>
#include <catena/flow/flow_preconditioner.h>

#include <deal.II/lac/solver_gmres.h>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Iterations for the response of the fluid to each rigid-body unknown:
    /// fewer where there are many to be found.
    unsigned int
    response_iterations(const unsigned int n_rigid)
    {
      return n_rigid <= 12 ? 2 : 1;
    }

    constexpr unsigned int strong_iterations = 5;
  } // namespace



  template <int dim>
  unsigned int
  FlowPreconditioner<dim>::set_up_cost() const
  {
    constexpr unsigned int multigrid = 10;
    const unsigned int     n         = matrices->n_rigid();
    return multigrid + n * (response_iterations(n) + 1);
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize(
    const MovingMesh<dim>                &mesh,
    const std::vector<NodeCoupling<dim>> &couplings,
    const FlowMatrices<dim>              &new_matrices)
  {
    matrices = &new_matrices;
    strong   = false;

    multigrid = VelocityMultigrid<dim>(mesh, couplings, new_matrices);
    velocity_src.reinit(matrices->velocity_rhs);
    pressure_src.reinit(matrices->pressure_rhs);
    pressure_dst.reinit(matrices->pressure_rhs);

    initialize_mass();
    initialize_rigid();
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::solve_velocity(VectorType        &dst,
                                          const VectorType  &src,
                                          const unsigned int steps) const
  {
    dst = 0.;
    IterationNumberControl control(steps, 1e-12);
    SolverGMRES<VectorType>(control).solve(matrices->fast_velocity,
                                           dst,
                                           src,
                                           multigrid);
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize_mass()
  {
    VectorType inverse_diagonal(pressure_src);
    for (const auto i : inverse_diagonal.locally_owned_elements())
      inverse_diagonal(i) = 1. / matrices->pressure_mass.diag_element(i);

    // eigenvalues of the P1 mass matrix scaled by its diagonal:
    // between 1/2 and (dim+2)/2
    typename MassInverse::AdditionalData data;
    data.degree              = 4;
    data.max_eigenvalue      = (dim + 2.) / 2.;
    data.smoothing_range     = dim + 2.;
    data.eig_cg_n_iterations = 0;
    data.preconditioner =
      std::make_shared<DiagonalMatrix<VectorType>>(inverse_diagonal);
    mass_inverse.initialize(matrices->pressure_mass, data);
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize_rigid()
  {
    const unsigned int n = matrices->n_rigid();
    rigid_responses.clear();
    rigid_schur = matrices->rigid_rigid;
    if (n == 0)
      return;

    VectorType column(velocity_src), response(velocity_src);
    for (unsigned int k = 0; k < n; ++k)
      {
        std::vector<double> unit(n, 0.);
        unit[k] = 1.;
        column  = 0.;
        matrices->velocity_rigid_product.vmult_add(column, unit);

        solve_velocity(response, column, response_iterations(n));
        rigid_responses.push_back(response);
        std::vector<double> reaction(n);
        matrices->rigid_velocity_product.Tvmult_add(reaction, response);
        Utilities::MPI::sum(reaction,
                            response.get_mpi_communicator(),
                            reaction);
        for (unsigned int l = 0; l < n; ++l)
          rigid_schur(l, k) -= reaction[l];
      }
    set_contacts(ContactBlocks());
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::set_contacts(const ContactBlocks &contacts)
  {
    const unsigned int n = rigid_schur.m(), m = contacts.n_contacts();
    small_inverse.reinit(n + m, n + m);
    for (unsigned int k = 0; k < n; ++k)
      {
        for (unsigned int l = 0; l < n; ++l)
          small_inverse(k, l) = rigid_schur(k, l);
        for (unsigned int c = 0; c < m; ++c)
          {
            small_inverse(k, n + c) =
              -contacts.shares[c] * contacts.rates(c, k);
            small_inverse(n + c, k) = contacts.rates(c, k);
          }
      }
    if (n + m > 0)
      small_inverse.gauss_jordan();
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::vmult(BlockVectorType       &dst,
                                 const BlockVectorType &src) const
  {
    mass_inverse.vmult(pressure_dst, src.block(1));
    dst.block(1).equ(-2., pressure_dst);

    velocity_src = src.block(0);
    velocity_src *= -1.;
    matrices->fast_gradient.vmult_add(velocity_src, dst.block(1));
    velocity_src *= -1.;
    if (strong)
      solve_velocity(dst.block(0), velocity_src, strong_iterations);
    else
      multigrid.vmult(dst.block(0), velocity_src);

    const unsigned int n = matrices->n_rigid();
    if (n == 0)
      return;
    std::vector<double> small = replicate(src.block(2)), forces(n);
    matrices->pressure_rigid_product.Tvmult_add(forces, dst.block(1));
    matrices->rigid_velocity_product.Tvmult_add(forces, dst.block(0));
    Utilities::MPI::sum(forces, src.block(0).get_mpi_communicator(), forces);
    for (unsigned int k = 0; k < n; ++k)
      small[k] -= forces[k];
    if (src.n_blocks() > 3)
      for (const double rate : replicate(src.block(3)))
        small.push_back(rate);

    Vector<double> rhs(small.begin(), small.end()), solution(small.size());
    small_inverse.vmult(solution, rhs);
    for (unsigned int k = 0; k < n; ++k)
      dst.block(0).add(-solution(k), rigid_responses[k]);
    for (const auto k : dst.block(2).locally_owned_elements())
      dst.block(2)(k) = solution(k);
    if (src.n_blocks() > 3)
      for (const auto c : dst.block(3).locally_owned_elements())
        dst.block(3)(c) = solution(n + c);
  }



  template class FlowPreconditioner<2>;
  template class FlowPreconditioner<3>;
} // namespace Catena

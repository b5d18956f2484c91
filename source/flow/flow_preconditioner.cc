#include <catena/base/replicated.h>
#include <catena/flow/flow_preconditioner.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector_memory.h>

#include <algorithm>

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
      return n_rigid <= 12 ? 3 : 2;
    }

    constexpr unsigned int strong_iterations = 5;

    /// What p is of M^-1 g, and the share of p that acts on a velocity of
    /// multigrid alone: those with the fewest iterations.
    constexpr float pressure_factor = -2.5f, acting_share = 0.8f;



    /// A of FlowSystem, the part of the velocities.
    template <int dim>
    class VelocityBlock
    {
    public:
      explicit VelocityBlock(const FlowSystem<dim> &system)
        : system(system)
        , no_motions(system.n_rigid(), 0.)
      {
        no_pressure.reinit(system.pressure_rhs);
        pressure_equations.reinit(no_pressure);
      }

      void
      vmult(FastVectorType &dst, const FastVectorType &src) const
      {
        system.template vmult<float>(Equations{dst,
                                               pressure_equations,
                                               motion_equations},
                                     Unknowns{src, no_pressure, no_motions});
      }

    private:
      using Equations =
        typename FlowSystem<dim>::template Equations<FastVectorType>;
      using Unknowns =
        typename FlowSystem<dim>::template Unknowns<FastVectorType>;

      const FlowSystem<dim>      &system;
      const std::vector<double>   no_motions;
      FastVectorType              no_pressure;
      mutable FastVectorType      pressure_equations;
      mutable std::vector<double> motion_equations;
    };
  } // namespace



  template <int dim>
  unsigned int
  FlowPreconditioner<dim>::set_up_cost() const
  {
    constexpr unsigned int multigrid = 10;
    const unsigned int     n         = system->n_rigid();
    return multigrid + n * response_iterations(n) + gap_pressures.size();
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::clear()
  {
    system    = nullptr;
    matrices  = nullptr;
    multigrid = VelocityMultigrid<dim>();
    mass_inverse.clear();
    gap_pressures = GapPressures<dim>();
    responses.clear();
    velocity_rows.clear();
    pressure_rows.clear();
    velocity_src = FastVectorType();
    pressure_src = FastVectorType();
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize(
    const MovingMesh<dim>                &mesh,
    const std::vector<NodeCoupling<dim>> &couplings,
    const FlowSystem<dim>                &new_system,
    const PreconditionerMatrices<dim>    &new_matrices,
    const Configuration<dim>             &configuration)
  {
    clear();
    system   = &new_system;
    matrices = &new_matrices;
    strong   = false;

    multigrid = VelocityMultigrid<dim>(mesh, couplings, new_matrices);
    velocity_src.reinit(system->velocity_rhs);
    pressure_src.reinit(system->pressure_rhs);

    initialize_mass();
    gap_pressures =
      GapPressures<dim>(mesh, configuration, matrices->pressure_mass);
    initialize_responses();
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::solve_velocity(FastVectorType       &dst,
                                          const FastVectorType &src,
                                          const unsigned int    steps) const
  {
    dst = 0.;
    IterationNumberControl control(steps, 1e-12);
    SolverFGMRES<FastVectorType>(control).solve(VelocityBlock<dim>(*system),
                                                dst,
                                                src,
                                                multigrid);
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize_mass()
  {
    FastVectorType inverse_diagonal;
    inverse_diagonal.reinit(system->pressure_rhs);
    for (const auto i : inverse_diagonal.locally_owned_elements())
      inverse_diagonal(i) = 1.f / matrices->pressure_mass.el(i, i);

    // eigenvalues of the P1 mass matrix scaled by its diagonal:
    // between 1/2 and (dim+2)/2
    typename MassInverse::AdditionalData data;
    data.degree              = 3;
    data.max_eigenvalue      = (dim + 2.) / 2.;
    data.smoothing_range     = dim + 2.;
    data.eig_cg_n_iterations = 0;
    data.preconditioner =
      std::make_shared<DiagonalMatrix<FastVectorType>>(inverse_diagonal);
    mass_inverse.initialize(matrices->pressure_mass, data);
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::initialize_responses()
  {
    const unsigned int n_rigid = system->n_rigid(),
                       n       = n_rigid + gap_pressures.size();
    schur.reinit(n, n);

    FastVectorType no_velocity, no_pressure;
    no_velocity.reinit(velocity_src);
    no_pressure.reinit(system->pressure_rhs);
    FastVectorType column(no_velocity), pressures(no_pressure),
      response(no_velocity);
    std::vector<double>                                                forces;
    const typename FlowSystem<dim>::template Equations<FastVectorType> products{
      column, pressures, forces};
    for (unsigned int k = 0; k < n_rigid; ++k)
      {
        std::vector<double> unit(n_rigid, 0.);
        unit[k] = 1.;
        const typename FlowSystem<dim>::template Unknowns<FastVectorType>
          motion{no_velocity, no_pressure, unit};
        system->Tvmult(products, motion);
        velocity_rows.add(column);
        pressure_rows.add(pressures);
        system->template vmult<float>(products, motion);
        const std::vector<double> flows = gap_pressures.products(pressures);
        forces.insert(forces.end(), flows.begin(), flows.end());
        for (unsigned int l = 0; l < n; ++l)
          schur(l, k) = forces[l];
        solve_velocity(response, column, response_iterations(n_rigid));
        responses.push_back(response);
      }
    for (unsigned int k = n_rigid; k < n; ++k)
      {
        pressures = 0.f;
        gap_pressures.add_to(pressures, k - n_rigid, 1.);
        matrices->gradient.vmult(column, pressures);
        velocity_rows.add(column);
        forces = pressure_rows.products(pressures);
        for (unsigned int l = 0; l < n_rigid; ++l)
          schur(l, k) = forces[l];
        multigrid.vmult(response, column);
        responses.push_back(response);
      }
    for (unsigned int k = 0; k < n; ++k)
      {
        const std::vector<double> reactions =
          velocity_rows.products(responses[k]);
        for (unsigned int l = 0; l < n; ++l)
          schur(l, k) -= reactions[l];
      }
    GrowingVectorMemory<FastVectorType>::release_unused_memory();
    set_contacts(ContactBlocks());
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::set_contacts(const ContactBlocks &contacts)
  {
    const unsigned int n_rigid = system->n_rigid(), n = schur.m(),
                       m = contacts.n_contacts();
    small_inverse.reinit(n + m, n + m);
    if (n > 0)
      small_inverse.fill(schur);
    for (unsigned int k = 0; k < n_rigid; ++k)
      for (unsigned int c = 0; c < m; ++c)
        {
          small_inverse(k, n + c) = -contacts.shares[c] * contacts.rates(c, k);
          small_inverse(n + c, k) = contacts.rates(c, k);
        }
    if (n + m > 0)
      small_inverse.gauss_jordan();
  }



  template <int dim>
  FullMatrix<double>
  FlowPreconditioner<dim>::rigid_resistance() const
  {
    FullMatrix<double> result(system->n_rigid());
    if (!result.empty())
      result.fill(schur);
    return result;
  }



  /// With the factors of the responses in front of @p factors, in pieces that
  /// stay in the cache.
  template <int dim>
  void
  FlowPreconditioner<dim>::subtract_responses(
    FastVectorType       &velocity,
    const Vector<double> &factors) const
  {
    constexpr unsigned int piece = 4096;

    const unsigned int size = velocity.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += piece)
      for (unsigned int k = 0; k < responses.size(); ++k)
        {
          const float        factor   = factors(k);
          const float *const response = responses[k].begin();
          float *const       values   = velocity.begin();
          for (unsigned int i = begin; i < std::min(begin + piece, size); ++i)
            values[i] -= factor * response[i];
        }
  }



  template <int dim>
  void
  FlowPreconditioner<dim>::vmult(FastBlockVectorType       &dst,
                                 const FastBlockVectorType &src) const
  {
    const std::vector<double> flows = gap_pressures.products(src.block(1));
    pressure_src                    = src.block(1);
    gap_pressures.remove(pressure_src, flows);

    mass_inverse.vmult(dst.block(1), pressure_src);
    const float share = strong ? 1.f : acting_share;
    dst.block(1) *= share * pressure_factor;
    matrices->gradient.residual(velocity_src, dst.block(1), src.block(0));
    dst.block(1) *= 1.f / share;
    if (strong)
      solve_velocity(dst.block(0), velocity_src, strong_iterations);
    else
      multigrid.vmult(dst.block(0), velocity_src);

    const unsigned int n = schur.m();
    if (n == 0)
      return;
    std::vector<double> small;
    if (system->n_rigid() > 0)
      small = replicate(src.block(2));
    small.insert(small.end(), flows.begin(), flows.end());
    const std::vector<double> of_velocity =
                                velocity_rows.products(dst.block(0)),
                              of_pressure =
                                pressure_rows.products(dst.block(1));
    for (unsigned int k = 0; k < n; ++k)
      small[k] -= of_velocity[k];
    for (unsigned int k = 0; k < system->n_rigid(); ++k)
      small[k] -= of_pressure[k];
    if (src.n_blocks() > 3)
      for (const double rate : replicate(src.block(3)))
        small.push_back(rate);

    Vector<double> rhs(small.begin(), small.end()), solution(small.size());
    small_inverse.vmult(solution, rhs);
    subtract_responses(dst.block(0), solution);
    for (unsigned int k = 0; k < gap_pressures.size(); ++k)
      gap_pressures.add_to(dst.block(1), k, solution(system->n_rigid() + k));
    if (src.n_blocks() > 2)
      for (const auto k : dst.block(2).locally_owned_elements())
        dst.block(2)(k) = solution(k);
    if (src.n_blocks() > 3)
      for (const auto c : dst.block(3).locally_owned_elements())
        dst.block(3)(c) = solution(n + c);
  }



  template class FlowPreconditioner<2>;
  template class FlowPreconditioner<3>;
} // namespace Catena

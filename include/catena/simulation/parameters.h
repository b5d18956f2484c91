#ifndef catena_simulation_parameters_h
#define catena_simulation_parameters_h

#include <catena/conformation/conformation_solver.h>
#include <catena/flow/flow_solver.h>
#include <catena/flow/nonlinear_flow_solver.h>
#include <catena/mesh/mesher.h>
#include <catena/rheology/fluid_parameters.h>
#include <catena/scene/scene.h>
#include <catena/simulation/checkpoint.h>
#include <catena/simulation/step_control.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Catena
{
  /**
   * All parameters of a simulation but those of its scene. Units: a, gamma,
   * eta0.
   */
  struct SimulationParameters
  {
    FluidParameters fluid;

    /// d_min: the smallest gap between particles, divided by the diameter
    double minimal_gap = 0.02;

    StepControlParameters step_control;
    double                final_strain = 50.;
    /// over which the forces that held particles at first go to zero
    double release_strain = 1.;
    /// strains at which the walls change their direction
    std::vector<double> reversal_strains;

    MeshParameters mesh;
    /// remesh below this fraction of the quality of a new mesh
    double remesh_quality = 0.35;
    /// remesh below this fraction of the wanted elements across a gap
    double remesh_gap = 0.6;

    FlowSolverParameters         flow_solver;
    NonlinearSolverParameters    nonlinear_solver;
    ConformationSolverParameters conformation_solver;

    std::string         output_directory = "results";
    std::vector<double> field_strains;

    CheckpointParameters checkpoint;

    /// Is there a conformation field?
    bool
    viscoelastic() const
    {
      return fluid.model == FluidParameters::Model::giesekus;
    }

    /// Declare all entries, in their subsections.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError
    void
    check() const;

    /// Do they go together with @p scene?
    /// @throws InputError
    template <int dim>
    void
    check_scene(const Scene<dim> &scene) const;

  private:
    void
    declare_mesh(dealii::ParameterHandler &prm);
  };
} // namespace Catena

#endif

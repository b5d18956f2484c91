#include <catena/base/exceptions.h>
#include <catena/simulation/parameters.h>

namespace Catena
{
  using namespace dealii;

  void
  SimulationParameters::declare_mesh(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    mesh.declare(prm);
    prm.add_parameter("Remesh quality",
                      remesh_quality,
                      "A new mesh is made when the quality has fallen below "
                      "this fraction of that of the last new mesh.",
                      Patterns::Double());
    prm.add_parameter("Remesh gap",
                      remesh_gap,
                      "A new mesh is made when fewer elements lie across a "
                      "gap than this fraction of 'Elements across gap'.",
                      Patterns::Double());
    prm.leave_subsection();
  }



  void
  SimulationParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Fluid");
    fluid.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Particles");
    prm.add_parameter("Minimal gap",
                      minimal_gap,
                      "d_min, the smallest gap between two surfaces divided "
                      "by the particle diameter.",
                      Patterns::Double());
    prm.leave_subsection();

    prm.enter_subsection("Time");
    step_control.declare(prm);
    prm.add_parameter("Final strain",
                      final_strain,
                      "Strain gamma t at which the run ends, counted from the "
                      "release of the particles.",
                      Patterns::Double());
    prm.add_parameter("Reversal strains",
                      reversal_strains,
                      "Strains at which the walls change their direction, in "
                      "growing order and separated by commas; none by "
                      "default. Strain goes on to be counted as gamma t.");
    prm.leave_subsection();

    declare_mesh(prm);

    prm.enter_subsection("Flow solver");
    flow_solver.declare(prm);
    nonlinear_solver.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Conformation solver");
    conformation_solver.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Output");
    prm.add_parameter("Directory", output_directory, "Folder of the results.");
    prm.add_parameter("Field strains",
                      field_strains,
                      "Strains at which the fields are written for ParaView, "
                      "separated by commas.");
    prm.leave_subsection();

    prm.enter_subsection("Checkpoint");
    checkpoint.declare(prm);
    prm.leave_subsection();
  }



  void
  SimulationParameters::check() const
  {
    fluid.check();
    require(minimal_gap > 0. && minimal_gap < 1.,
            "Particles/Minimal gap",
            minimal_gap,
            "choose a value between 0.001 and 1, 0.02 is usual");
    step_control.check();
    require(final_strain >= 0.,
            "Time/Final strain",
            final_strain,
            "choose a strain that is not negative");
    for (unsigned int i = 0; i < reversal_strains.size(); ++i)
      require(reversal_strains[i] > (i > 0 ? reversal_strains[i - 1] : 0.),
              "Time/Reversal strains",
              reversal_strains[i],
              "choose positive strains in growing order");
    mesh.check();
    require(remesh_quality > 0. && remesh_quality < 1.,
            "Mesh/Remesh quality",
            remesh_quality,
            "choose a fraction between 0 and 1");
    require(remesh_gap >= 0. && remesh_gap < 1.,
            "Mesh/Remesh gap",
            remesh_gap,
            "choose a fraction between 0 and 1");
    flow_solver.check();
    nonlinear_solver.check();
    conformation_solver.check();
    checkpoint.check();
    for (const double strain : field_strains)
      require(strain <= final_strain,
              "Output/Field strains",
              strain,
              "choose strains up to 'Time/Final strain'");
  }
} // namespace Catena

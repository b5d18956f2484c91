#include <catena/base/exceptions.h>
#include <catena/particles/contacts.h>
#include <catena/simulation/parameters.h>

#include <cmath>

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
    prm.add_parameter("Release strain",
                      release_strain,
                      "Strain over which the forces that held the particles of "
                      "a viscoelastic scene in place go to zero, linearly.",
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
                      "separated by commas; a time step ends at each.");
    prm.leave_subsection();

    prm.enter_subsection("Checkpoint");
    checkpoint.declare(prm);
    prm.leave_subsection();
  }



  void
  SimulationParameters::check() const
  {
    fluid.check();
    require(!viscoelastic() || (fluid.giesekus.weissenberg_number >= 1e-4 &&
                                fluid.giesekus.weissenberg_number <= 1e4),
            "Fluid/Weissenberg number",
            fluid.giesekus.weissenberg_number,
            "a simulation needs a value from 1e-4 to 1e4; for a fluid without "
            "elasticity choose 'Fluid/Model' = newtonian");
    require(minimal_gap >= 1e-6 && minimal_gap < 1.,
            "Particles/Minimal gap",
            minimal_gap,
            "choose a value from 1e-6 to below 1, 0.02 is usual");
    step_control.check();
    require(final_strain >= 0. && final_strain <= 1e6,
            "Time/Final strain",
            final_strain,
            "choose a strain from 0 to 1e6");
    require(release_strain >= 1e-3 && release_strain <= 1e3,
            "Time/Release strain",
            release_strain,
            "choose a strain from 0.001 to 1000, 1 is usual");
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
    require(!output_directory.empty(),
            "Output/Directory",
            "''",
            "name a folder for the results");
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



  namespace
  {
    /// No computer has room for more.
    constexpr double most_elements = 1e9;

    /// Volume of regular tetrahedra and triangles with edges of length 1.
    template <int dim>
    constexpr double volume_of_element = dim == 3 ? 0.11785 : 0.43301;
  } // namespace



  template <int dim>
  void
  SimulationParameters::check_scene(const Scene<dim> &scene) const
  {
    scene.check();
    require(reversal_strains.empty() || !scene.pressure_driven(),
            "Time/Reversal strains",
            reversal_strains.empty() ? 0. : reversal_strains[0],
            "there is no shear to turn back: leave it empty");
    double volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= scene.upper()[d] - scene.lower()[d];
    const double n_elements =
      volume / (volume_of_element<dim> * std::pow(mesh.maximal_size, dim));
    require(n_elements < most_elements,
            "Mesh/Maximal size",
            mesh.maximal_size,
            "the box would get more than " + std::to_string(n_elements) +
              " elements: choose a larger size or a smaller box");

    Configuration<dim> configuration;
    for (const Particle<dim> &particle : scene.particles)
      configuration.centres.push_back(particle.centre);
    try
      {
        Contacts<dim>(scene, minimal_gap).enforce(configuration);
      }
    catch (const SolverError &)
      {
        throw InputError("Particles/Minimal gap",
                         minimal_gap,
                         "the box has no room for the particles with this gap "
                         "between them and to the walls: choose a smaller one "
                         "or enlarge the box");
      }
  }



  template void
  SimulationParameters::check_scene(const Scene<2> &) const;
  template void
  SimulationParameters::check_scene(const Scene<3> &) const;
} // namespace Catena

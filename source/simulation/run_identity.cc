#include <catena/base/parameter_file.h>
#include <catena/simulation/run_identity.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Parameters and sections that may change.
    const std::vector<std::string> changeable = {"Time / Final strain",
                                                 "Time / Tolerance",
                                                 "Mesh / Time limit",
                                                 "Flow solver / ",
                                                 "Conformation solver / ",
                                                 "Output / ",
                                                 "Checkpoint / "};

    bool
    may_change(const std::string &name)
    {
      return std::any_of(changeable.begin(),
                         changeable.end(),
                         [&](const std::string &beginning) {
                           return name.compare(0,
                                               beginning.size(),
                                               beginning) == 0;
                         });
    }
  } // namespace



  template <typename T>
  void
  RunIdentity::add(const std::string &name, const T &value)
  {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << value;
    names.push_back(name);
    values.push_back(text.str());
  }



  template <int dim>
  RunIdentity::RunIdentity(const Scene<dim>    &scene,
                           SimulationParameters parameters)
  {
    ParameterHandler prm;
    parameters.declare(prm);
    std::stringstream text;
    prm.print_parameters(text,
                         ParameterHandler::ShortPRM |
                           ParameterHandler::KeepDeclarationOrder);
    for (const ParameterSetting &setting : scan_parameters(text, "parameters"))
      add(setting.full_name(), setting.value);

    add("dimension", dim);
    add("length of the box", scene.length);
    add("height of the box", scene.height);
    add("width of the box", scene.width);
    add("symmetry of the box", static_cast<int>(scene.symmetry));
    add("drive of the flow", static_cast<int>(scene.drive));
    add("number of particles", scene.particles.size());
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      {
        const Particle<dim> &particle = scene.particles[i];
        const std::string    name     = " of particle " + std::to_string(i);
        add("first place" + name, particle.centre);
        add("radius" + name, particle.radius);
        add("fixed place" + name, particle.fixed);
      }
  }



  void
  RunIdentity::check_continues(const RunIdentity &checkpoint) const
  {
    for (unsigned int i = 0; i < names.size(); ++i)
      {
        if (may_change(names[i]))
          continue;
        const auto found =
          std::find(checkpoint.names.begin(), checkpoint.names.end(), names[i]);
        const auto index = found - checkpoint.names.begin();
        const bool known = found != checkpoint.names.end() &&
                           checkpoint.values.size() == checkpoint.names.size();
        require(known && checkpoint.values[index] == values[i],
                names[i],
                values[i],
                known ? "the checkpoint is of a run with " +
                          checkpoint.values[index] +
                          ": resume with that, or start anew with another "
                          "--output" :
                        "the checkpoint is of a run without it: start anew "
                        "with another --output");
      }
  }



  template RunIdentity::RunIdentity(const Scene<2> &, SimulationParameters);
  template RunIdentity::RunIdentity(const Scene<3> &, SimulationParameters);
} // namespace Catena

// Thousands of parameter files with random damage are refused in one line, or
// say something a simulation can do. Each is judged as by --validate.

#include <catena/base/error_text.h>
#include <catena/base/parameter_file.h>
#include <catena/scene/line_of_particles.h>
#include <catena/scene/many_particles.h>
#include <catena/scene/one_particle.h>
#include <catena/simulation/parameters.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "../tests.h"

#include "../base/mutations.h"

using namespace Catena;

namespace
{
  /// What is refused for good, and what is accepted.
  struct Count
  {
    unsigned int refused = 0, accepted = 0, bad_refusals = 0, nonsense = 0;
  };



  bool
  within(const double x, const double low, const double high)
  {
    return x >= low && x <= high;
  }



  /// Could these be simulated?
  bool
  makes_sense(const SimulationParameters &p)
  {
    return within(p.step_control.time_step, 1e-6, 1.) &&
           within(p.final_strain, 0., 1e6) && p.minimal_gap > 0. &&
           p.minimal_gap < 1. && p.mesh.elements_on_equator >= 8 &&
           p.mesh.elements_on_equator <= 2000 &&
           within(p.mesh.maximal_size, 1e-3, 1e4) &&
           within(p.fluid.giesekus.mobility_parameter, 0., 1.) &&
           (p.fluid.model != FluidParameters::Model::giesekus ||
            within(p.fluid.giesekus.solvent_viscosity_ratio, 0., 1.)) &&
           (p.fluid.model != FluidParameters::Model::carreau ||
            p.fluid.carreau.power_index > 0.) &&
           within(p.flow_solver.tolerance, 1e-14, 1e-2) &&
           !p.output_directory.empty();
  }



  template <int dim>
  bool
  makes_sense(const Scene<dim> &scene)
  {
    bool good = within(scene.length, 0., 1e4) && within(scene.height, 0., 1e4);
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      {
        const Particle<dim> &particle = scene.particles[i];
        good =
          good && within(particle.radius, 1e-3, 1e3) &&
          std::abs(particle.centre[1]) + particle.radius < scene.height / 2.;
        for (unsigned int j = 0; j < i; ++j)
          good = good && scene.gap(i, j) > 0.;
      }
    return good;
  }



  /// Judge @p text as the parameter file of a program with this scene.
  template <typename SceneParameters>
  void
  judge(const std::string &text, SceneParameters scene, Count &count)
  {
    const std::string name = "damaged.prm";
    std::ofstream(name, std::ios::binary) << text;

    SimulationParameters     simulation;
    dealii::ParameterHandler prm;
    scene.declare(prm);
    simulation.declare(prm);
    try
      {
        read_parameters(prm, name);
        scene.check();
        simulation.check();
        simulation.check_scene(scene.template scene<3>());
      }
    catch (const Error &error)
      {
        ++count.refused;
        const std::string message = error_text(error);
        if (message.size() < 10 || message.find('\n') != std::string::npos)
          {
            ++count.bad_refusals;
            std::cout << "refused with: " << message << std::endl;
          }
        return;
      }
    catch (const std::exception &error)
      {
        ++count.bad_refusals;
        std::cout << "refused with: " << error.what() << '\n'
                  << text << std::endl;
        return;
      }
    ++count.accepted;
    if (!makes_sense(simulation) || !makes_sense(scene.template scene<3>()))
      {
        ++count.nonsense;
        std::cout << "accepted:\n" << text << std::endl;
      }
  }



  /// @p text with the value of one of its settings replaced.
  std::string
  with_other_value(const std::string &text, Tests::Mutations &mutations)
  {
    static const std::vector<std::string> values = {
      "0",           "-1",        "1",          "1e308",
      "-1e308",      "1e-308",    "nan",        "inf",
      "-inf",        "1e400",     "2147483648", "99999999999999999999",
      "0x10",        "",          "true",       "giesekus",
      "1;2;3",       ", ,",       "{1}",        "1e3",
      "1e6",         "0.5",       "2",          "-0",
      "1 2",         "%s%n",      "\xff\xfe",   "../../..",
      "1.0.0",       "newtonian", "carreau",    "quarter",
      "0,0,0; 0,0,0"};

    std::vector<std::string> lines;
    std::istringstream       input(text);
    for (std::string line; std::getline(input, line);)
      lines.push_back(line);
    for (unsigned int trial = 0; trial < 100; ++trial)
      {
        std::string &line = lines[mutations.below(lines.size())];
        const auto   at   = line.find('=');
        if (at == std::string::npos || line.find("set") == std::string::npos)
          continue;
        line =
          line.substr(0, at + 1) + " " + values[mutations.below(values.size())];
        break;
      }
    std::string result;
    for (const std::string &line : lines)
      result += line + "\n";
    return result;
  }



  template <typename SceneParameters>
  void
  test(Tests::Claims         &claims,
       const std::string     &program,
       const SceneParameters &scene,
       const unsigned int     seed)
  {
    // all settings, as --template writes them
    SceneParameters          declared = scene;
    SimulationParameters     simulation;
    dealii::ParameterHandler prm;
    declared.declare(prm);
    simulation.declare(prm);
    std::ostringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::ShortPRM);

    Tests::Mutations mutations(seed);
    Count            count;
    for (unsigned int i = 0; i < 1500; ++i)
      {
        std::string damaged = text.str();
        for (unsigned int n = 1 + mutations.below(3); n > 0; --n)
          damaged = i % 3 == 0 ? mutations.damaged(damaged) :
                                 with_other_value(damaged, mutations);
        judge(damaged, scene, count);
      }
    std::cout << program << ": " << count.refused << " refused, "
              << count.accepted << " accepted" << std::endl;
    claims.near(program + ": all refusals are one line of ours",
                count.bad_refusals,
                0.,
                0.);
    claims.near(program + ": no nonsense is accepted", count.nonsense, 0., 0.);
    claims.at_least(program + ": some files are refused", count.refused, 300.);
    claims.at_least(program + ": some are not", count.accepted, 20.);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    ManyParticlesParameters many;
    many.number = 4;
    test(claims, "two_particles", LineOfParticlesParameters(2), 1);
    test(claims, "three_particles", LineOfParticlesParameters(3), 2);
    test(claims, "many_particles", many, 3);
    test(claims, "one_particle", OneParticleParameters(), 4);
  });
}

#ifndef catena_tests_verification_new_meshes_h
#define catena_tests_verification_new_meshes_h

#include <catena/scene/line_of_particles.h>
#include <catena/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "../tests.h"

#include "../print.h"

namespace Catena
{
  namespace Tests
  {
    /// By how much a run with a new mesh differs from the run without one.
    struct Trace
    {
      double spin     = 0.; // gamma
      double velocity = 0.; // a gamma
      double force    = 0.; // F_S
    };



    /// The larger one of each.
    inline Trace
    largest(const Trace &a, const Trace &b)
    {
      return {std::max(a.spin, b.spin),
              std::max(a.velocity, b.velocity),
              std::max(a.force, b.force)};
    }



    inline Trace
    difference(const State<3> &a, const State<3> &b)
    {
      const auto &one = a.now.flow, &other = b.now.flow;
      return {std::abs(one.motions[0].angular_velocity[2] -
                       other.motions[0].angular_velocity[2]),
              std::abs(one.motions[0].velocity.norm() -
                       other.motions[0].velocity.norm()),
              std::abs(one.contact_forces.at(0) - other.contact_forces.at(0)) /
                (6. * dealii::numbers::PI)};
    }



    /// @p simulation once more.
    inline std::unique_ptr<Simulation<3>>
    copy(Simulation<3>              &simulation,
         const Scene<3>             &scene,
         const SimulationParameters &parameters)
    {
      Archive saved;
      simulation.archive(saved);
      Archive loaded(
        dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, saved.bytes()));
      auto result =
        std::make_unique<Simulation<3>>(scene, parameters, MPI_COMM_WORLD);
      result->archive(loaded);
      loaded.finish();
      return result;
    }



    /**
     * A pair at the smallest gap in a Giesekus fluid with Wi = 3, alpha = 0.01,
     * beta = 0.1, in time steps of @p dt and without a new mesh. From each of
     * @p strains on, a copy goes on with a new mesh, for @p n_steps steps. It
     * is a claim that a force holds the gap in all of them.
     *
     * @return for each of the strains the largest differences of the two
     */
    inline std::vector<Trace>
    traces_of_new_meshes(Claims                    &claims,
                         const unsigned int         elements_on_equator,
                         const unsigned int         elements_across_gap,
                         const double               dt,
                         const std::vector<double> &strains,
                         const unsigned int         n_steps)
    {
      LineOfParticlesParameters line(2);
      line.distance        = 1.021;
      const Scene<3> scene = line.scene<3>();

      SimulationParameters parameters;
      auto                &giesekus       = parameters.fluid.giesekus;
      giesekus.weissenberg_number         = 3.;
      giesekus.mobility_parameter         = 0.01;
      giesekus.solvent_viscosity_ratio    = 0.1;
      parameters.step_control.time_step   = dt;
      parameters.final_strain             = strains.back() + n_steps * dt;
      parameters.mesh.elements_on_equator = elements_on_equator;
      parameters.mesh.elements_across_gap = elements_across_gap;
      parameters.remesh_quality           = 1e-3;

      struct Copy
      {
        std::unique_ptr<Simulation<3>> simulation;
        unsigned int                   trace, n_steps;
      };
      std::vector<Copy>  copies;
      std::vector<Trace> traces;
      double             least_force = std::numeric_limits<double>::max();
      Simulation<3>      without(scene, parameters, MPI_COMM_WORLD);
      without.initialize();
      while (traces.size() < strains.size() || !copies.empty())
        {
          if (traces.size() < strains.size() &&
              without.strain() > strains[traces.size()] - dt / 2.)
            {
              copies.push_back({copy(without, scene, parameters),
                                static_cast<unsigned int>(traces.size()),
                                n_steps});
              copies.back().simulation->request_remesh();
              traces.emplace_back();
            }
          without.advance();
          for (Copy &with : copies)
            {
              least_force =
                std::min(least_force,
                         without.current_state().now.flow.contact_forces.at(0));
              with.simulation->advance();
              Trace &trace = traces[with.trace];
              trace        = largest(trace,
                              difference(with.simulation->current_state(),
                                         without.current_state()));
              if (--with.n_steps == 0)
                print("new mesh at strain ",
                      strains[with.trace],
                      ": spin ",
                      trace.spin,
                      ", velocity ",
                      trace.velocity,
                      ", force ",
                      trace.force);
            }
          copies.erase(std::remove_if(copies.begin(),
                                      copies.end(),
                                      [](const Copy &c) {
                                        return c.n_steps == 0;
                                      }),
                       copies.end());
        }
      claims.holds("there is a force to compare",
                   least_force / (6. * dealii::numbers::PI) > 0.1);
      return traces;
    }



    /// The largest of each.
    inline Trace
    largest(const std::vector<Trace> &traces)
    {
      Trace result;
      for (const Trace &trace : traces)
        result = largest(result, trace);
      return result;
    }
  } // namespace Tests
} // namespace Catena

#endif

#ifndef catena_tests_verification_spheres_in_a_line_h
#define catena_tests_verification_spheres_in_a_line_h

#include <catena/flow/flow_solver.h>
#include <catena/flow/stress_model.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/particles/contacts.h>
#include <catena/simulation/remesher.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "../tests.h"

#include "../mesh/scenes.h"

namespace Catena
{
  namespace Tests
  {
    /**
     * Two equal spheres, or three with the middle one at the origin, in a line
     * that is centred in the box.
     */
    struct Line
    {
      unsigned int n_spheres;
      /// of neighbouring centres [a]
      double distance;
      /// of the line against x
      double degrees;
      /// sizes of the box over those of the paper, 80 x 40 x 20
      double   box      = 4.;
      Symmetry symmetry = Symmetry::quarter;

      dealii::Tensor<1, 3>
      direction() const
      {
        const double         angle = degrees * dealii::numbers::PI / 180.;
        dealii::Tensor<1, 3> d;
        d[0] = std::cos(angle);
        d[1] = std::sin(angle);
        return d;
      }

      Scene<3>
      scene() const
      {
        Scene<3> result;
        result.length *= box;
        result.height *= box;
        result.width *= box;
        result.symmetry = symmetry;

        const double outer = n_spheres == 2 ? distance / 2. : distance;
        const dealii::Point<3> centre(outer * direction());
        result.particles.push_back({centre});
        if (symmetry != Symmetry::quarter)
          result.particles.push_back({-centre});
        if (n_spheres == 3)
          result.particles.push_back(
            {dealii::Point<3>(), 1., symmetry == Symmetry::quarter});
        return result;
      }
    };



    /**
     * Values by name: the velocity of the outer sphere against its neighbour,
     * along the line of centres (away from it) and across, the spins, and the
     * force that holds the distance, over 6 pi eta0 gamma a^2.
     */
    using Quantities = std::map<std::string, double>;



    /**
     * What tests/reference says for unbounded fluid. The shear is u_x = -y:
     * with theta in (0, 90) degrees the spheres approach each other, the line
     * turns and the spheres spin in the positive direction.
     */
    inline Quantities
    exact_motion(const Line &line)
    {
      const bool        pair  = line.n_spheres == 2;
      const Table       table = read_table(pair ? "two_sphere_newtonian.csv" :
                                            "three_sphere_newtonian.csv");
      const auto       &distances = table[pair ? "r_over_a" : "X_over_a"];
      const std::size_t row =
        std::find(distances.begin(), distances.end(), line.distance) -
        distances.begin();
      const auto value = [&](const std::string &column) {
        return table[column].at(row);
      };

      const double angle = line.degrees * dealii::numbers::PI / 180.;
      const double s = std::sin(2. * angle), c = std::cos(2. * angle);
      Quantities   exact;
      exact["radial velocity"] =
        -(1. - value(pair ? "A" : "A3")) * line.distance * s / 2.;
      exact["transverse velocity"] =
        line.distance * (1. - (1. - value(pair ? "B" : "B3")) * c) / 2.;
      exact["spin of the outer sphere"] =
        (1. - value(pair ? "C" : "C_outer") * c) / 2.;
      if (!pair)
        exact["spin of the middle sphere"] = (1. - value("C_middle") * c) / 2.;
      exact["force that holds the gap"] =
        value("Fr_over_6pi_eta_a2_gammadot_at_sin2theta=1") * s;
      return exact;
    }



    /// Meshes like M2 and M3 of the paper.
    inline MeshParameters
    m2()
    {
      return resolution(64, 2);
    }

    inline MeshParameters
    m3()
    {
      return resolution(96, 3);
    }



    /**
     * The instantaneous motion of a line of spheres in a Newtonian fluid.
     */
    class ComputedMotion
    {
    public:
      ComputedMotion(const Line &line, const MeshParameters &mesh_parameters)
        : line(line)
        , scene(line.scene())
        , contacts(scene, line.distance / 2. - 1. + 1e-12)
      {
        scene.check();
        for (const auto &particle : scene.particles)
          configuration.centres.push_back(particle.centre);
        // they are closer than the minimal gap by a trifle: they are held
        contacts.enforce(configuration);

        SimulationParameters parameters;
        parameters.mesh = mesh_parameters;
        parameters.mesh.maximal_size *= line.box;
        discretization =
          Remesher<3>(scene, parameters, MPI_COMM_WORLD).make(configuration);
      }

      /**
       * Solve with free spheres, for their motion, and with the distance held,
       * for the force. This has no radial velocity and leaves the transverse
       * one and the spins alone: @p change is the largest deviation from that.
       */
      Quantities
      solve(double &change)
      {
        const MovingMesh<3>     &mesh = *discretization.mesh;
        const RigidBodies<3>     bodies(scene);
        const NewtonianStress<3> stress;
        FlowSolverParameters     parameters;
        parameters.tolerance = 1e-9;
        FlowSolver<3> solver(parameters);
        solver.reinit(mesh, bodies, configuration, false);
        solver.assemble(configuration, stress);

        FlowFields<3> fields;
        fields.velocity = mesh.vector_field();
        fields.pressure = mesh.scalar_field();
        fields.motions  = reference_motions<3>(scene, configuration, false);
        const std::vector<double> no_forces(bodies.n_unknowns(), 0.);
        solver.solve(fields, {}, no_forces);
        Quantities result = read(fields);

        solver.solve(fields, contacts.candidates(configuration), no_forces);
        const Quantities held = read(fields);
        change                = 0.;
        for (const auto &quantity : held)
          change = std::max(change,
                            std::abs(quantity.second -
                                     (quantity.first == "radial velocity" ?
                                        0. :
                                        result[quantity.first])));
        result["force that holds the gap"] =
          fields.contact_forces.at(0) / (6. * dealii::numbers::PI);

        std::cout << line.n_spheres << " spheres at " << line.distance
                  << " a and " << line.degrees << " degrees, box x " << line.box
                  << ": " << mesh.n_global_cells() << " cells, quality "
                  << discretization.initial_quality << std::endl;
        return result;
      }

      unsigned int
      n_cells() const
      {
        return discretization.mesh->n_global_cells();
      }

    private:
      const Line        line;
      const Scene<3>    scene;
      Contacts<3>       contacts;
      Configuration<3>  configuration;
      Discretization<3> discretization;

      /// Motions as quantities; those of the neighbour by symmetry.
      Quantities
      read(const FlowFields<3> &fields) const
      {
        const dealii::Tensor<1, 3> along = line.direction();
        dealii::Tensor<1, 3>       across;
        across[0] = -along[1];
        across[1] = along[0];

        // the neighbour moves in the opposite way, or is the middle sphere
        const double relative = line.n_spheres == 2 ? 2. : 1.;
        Quantities   result;
        result["radial velocity"] =
          relative * (fields.motions[0].velocity * along);
        result["transverse velocity"] =
          relative * (fields.motions[0].velocity * across);
        result["spin of the outer sphere"] =
          fields.motions[0].angular_velocity[2];
        if (line.n_spheres == 3)
          result["spin of the middle sphere"] =
            fields.motions.back().angular_velocity[2];
        return result;
      }
    };



    /**
     * Claim that every quantity has a relative error of at most @p bound, and
     * that holding the distance changes transverse velocity and spins by no
     * more than a tenth of that.
     */
    inline Quantities
    claim_exact_motion(Claims               &claims,
                       const std::string    &name,
                       const Line           &line,
                       const MeshParameters &mesh,
                       const double          bound)
    {
      double           change;
      const Quantities computed = ComputedMotion(line, mesh).solve(change);
      for (const auto &exact : exact_motion(line))
        claims.at_most(name + ": relative error of " + exact.first,
                       std::abs(computed.at(exact.first) / exact.second - 1.),
                       bound);
      claims.at_most(name + ": the force turns nothing", change, bound / 10.);
      return computed;
    }



    /**
     * Claims on the effect of the box: how much that of the paper changes, at
     * most @p in_paper, and that the effect goes with size^-3, from boxes of
     * once, twice and four times the size. A seventh of the last difference is
     * then left in the largest box.
     */
    inline void
    claim_box_effect(Claims               &claims,
                     const Line           &line,
                     const MeshParameters &mesh,
                     const double          in_paper)
    {
      double     change;
      const auto in_box = [&](const double size) {
        Line in_this = line;
        in_this.box  = size;
        return ComputedMotion(in_this, mesh).solve(change);
      };
      const Quantities paper = in_box(1.), twice = in_box(2.),
                       large = in_box(4.);

      for (const auto &exact : exact_motion(line))
        {
          const std::string &name  = exact.first;
          const double       first = paper.at(name) - twice.at(name);
          const double       last  = twice.at(name) - large.at(name);
          claims.at_most("effect of the paper's box on " + name,
                         std::abs((first + 8. / 7. * last) / exact.second),
                         in_paper);
          claims.at_most("effect of the largest box on " + name,
                         std::abs(last / 7. / exact.second),
                         0.001);
          if (name == "transverse velocity" ||
              name == "force that holds the gap")
            claims.near("third power of size in the effect on " + name,
                        std::log2(first / last),
                        3.,
                        0.5);
        }
    }
  } // namespace Tests
} // namespace Catena

#endif

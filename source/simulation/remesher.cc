#include <catena/base/exceptions.h>
#include <catena/base/replace_field.h>
#include <catena/conformation/conformation_transfer.h>
#include <catena/mesh/field_transfer.h>
#include <catena/particles/contacts.h>
#include <catena/scene/image_in_block.h>
#include <catena/simulation/remesher.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * The mesh as rank 0 makes it: not all of the mesher's algorithms give
     * the same mesh twice.
     */
    template <int dim>
    MeshDescription<dim>
    mesh_on_all_ranks(const Scene<dim>     &scene,
                      const MeshParameters &parameters,
                      const MPI_Comm        communicator)
    {
      MeshDescription<dim> description;
      std::string          failure;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        try
          {
            description = generate_mesh<dim>(scene, parameters);
          }
        catch (const std::exception &error)
          {
            failure = error.what();
          }
      failure = Utilities::MPI::broadcast(communicator, failure);
      if (!failure.empty())
        throw MeshError(failure);
      if (Utilities::MPI::n_mpi_processes(communicator) > 1)
        {
          const auto share = [&](auto &part) {
            part = Utilities::MPI::broadcast(communicator, part);
          };
          share(description.vertices);
          share(description.cells);
          share(description.boundary.boundary_lines);
          share(description.boundary.boundary_quads);
          share(description.attempts);
        }
      return description;
    }
  } // namespace



  namespace
  {
    /**
     * The configuration to a millionth of a radius: differences of rounding
     * between runs must not lead to different meshes.
     */
    template <int dim>
    Configuration<dim>
    rounded(Configuration<dim> configuration)
    {
      const auto round = [](const double x) {
        return std::round(x * 1e6) / 1e6;
      };
      configuration.frame_angle = round(configuration.frame_angle);
      for (Point<dim> &centre : configuration.centres)
        for (unsigned int d = 0; d < dim; ++d)
          centre[d] = round(centre[d]);
      return configuration;
    }
  } // namespace



  namespace
  {
    /**
     * How well a plane can be meshed at @p distance from the centre of a
     * sphere: badly if it nearly touches the sphere or cuts it near its pole.
     */
    double
    suitability(const double distance, const double radius)
    {
      constexpr double most  = 20.;
      const double     d     = std::abs(distance);
      const double     depth = radius - d;
      return depth > 0. ? std::min(depth, d) : std::min(most, -10. * depth);
    }



    /// The worst suitability of the identified planes for the particles.
    template <int dim>
    double
    suitability(const Scene<dim> &scene)
    {
      const bool x_cut = scene.rotational() && scene.cut == Cut::x_plane;
      double     worst = std::numeric_limits<double>::max();
      for (const Particle<dim> &p : scene.particles)
        for (const Image<dim> &image : scene.images())
          {
            if (p.on_axis)
              continue;
            const Point<dim> c = image(p.centre);
            worst              = std::min({worst,
                                           suitability(c[0] - scene.lower()[0], p.radius),
                                           suitability(c[0] - scene.upper()[0], p.radius)});
            if (scene.rotational() && !x_cut)
              worst = std::min(worst, suitability(c[1], p.radius));
          }
      return worst;
    }



    /**
     * The ways to cut the block out of the box, the usual ones first: both
     * cuts of a rotationally symmetric box, and windows of the period.
     */
    template <int dim>
    std::vector<Scene<dim>>
    possible_layouts(Scene<dim> scene)
    {
      constexpr int           n_windows = 64;
      std::vector<Scene<dim>> layouts;
      scene.cut           = Cut::x_plane;
      scene.window_centre = 0.;
      layouts.push_back(scene);
      if (scene.rotational())
        scene.cut = Cut::y_plane;
      for (int i = 0; i < n_windows; ++i)
        {
          // 0, 1, -1, 2, -2, ...
          scene.window_centre =
            (i % 2 == 1 ? 1 : -1) * ((i + 1) / 2) * scene.length / n_windows;
          layouts.push_back(scene);
        }
      return layouts;
    }
  } // namespace



  namespace
  {
    template <int dim>
    Scene<dim>
    with_particles(Scene<dim> scene, const Configuration<dim> &configuration)
    {
      for (unsigned int i = 0; i < scene.particles.size(); ++i)
        scene.particles[i].centre = configuration.centres[i];
      return scene;
    }
  } // namespace



  template <int dim>
  Remesher<dim>::Remesher(const Scene<dim>           &scene,
                          const SimulationParameters &parameters,
                          const MPI_Comm              communicator)
    : scene(scene)
    , parameters(parameters)
    , communicator(communicator)
  {}



  template <int dim>
  Scene<dim>
  Remesher<dim>::layout_for(const Configuration<dim> &configuration) const
  {
    const std::vector<Scene<dim>> options =
      possible_layouts(with_particles(scene, rounded(configuration)));
    return *std::max_element(options.begin(),
                             options.end(),
                             [](const auto &a, const auto &b) {
                               return suitability(a) < suitability(b);
                             });
  }



  /**
   * The configuration with narrow gaps wide enough for the mesh to be stretched
   * in them when they are closed again; as it is if there is no room.
   */
  template <int dim>
  Configuration<dim>
  Remesher<dim>::widened(const Configuration<dim> &configuration) const
  {
    const double narrowest =
      2. * Contacts<dim>(scene, 0.).smallest_gap(configuration);
    const double wanted = std::min(parameters.mesh.gap_stretch * narrowest,
                                   parameters.mesh.widest_refined_gap());
    if (!(wanted > narrowest))
      return configuration;
    try
      {
        Configuration<dim> result = configuration;
        Contacts<dim>(scene, wanted / 2.).enforce(result);
        return result;
      }
    catch (const SolverError &)
      {
        return configuration;
      }
  }



  template <int dim>
  Discretization<dim>
  Remesher<dim>::make(const Configuration<dim> &configuration) const
  {
    return make(layout_for(configuration), configuration);
  }



  /**
   * In the block of @p layout.
   */
  template <int dim>
  Discretization<dim>
  Remesher<dim>::make(const Scene<dim>         &layout,
                      const Configuration<dim> &configuration) const
  {
    const auto made_at = [&](const Configuration<dim> &reference) {
      const Scene<dim>           meshed = with_particles(layout, reference);
      const MeshDescription<dim> description =
        mesh_on_all_ranks<dim>(meshed, parameters.mesh, communicator);

      Discretization<dim> result;
      result.attempts = description.attempts;
      result.mesh =
        std::make_unique<MovingMesh<dim>>(communicator, meshed, description);
      result.mover = std::make_unique<MeshMover<dim>>(*result.mesh, reference);
      result.mesh->set_positions(result.mover->positions(configuration));
      result.initial_quality = result.mesh->quality();
      return result;
    };

    const Configuration<dim> wide     = rounded(widened(configuration)),
                             as_it_is = rounded(configuration);
    Discretization<dim> result        = made_at(wide);
    // large curved cells may not bear to be pressed
    if (!(result.initial_quality > 0.) && wide.centres != as_it_is.centres)
      {
        const unsigned int failed = result.attempts;
        result                    = made_at(as_it_is);
        result.attempts += failed;
      }
    if (!(result.initial_quality > 0.))
      throw MeshError("The new mesh is inverted.");
    return result;
  }



  template <int dim>
  bool
  Remesher<dim>::is_due(const Discretization<dim> &discretization,
                        const Configuration<dim>  &configuration) const
  {
    const MovingMesh<dim> &mesh = *discretization.mesh;
    if (mesh.quality() <
        parameters.remesh_quality * discretization.initial_quality)
      return true;

    const Scene<dim> &layout = mesh.scene();
    const auto       &x      = configuration.centres;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (!layout.particles[i].on_axis)
        {
          // it has left the block: its image comes back
          const double radius = layout.particles[i].radius;
          if (x[i][0] < layout.lower()[0] - radius ||
              x[i][0] > layout.upper()[0] + radius)
            return true;
        }
    for (unsigned int i = 0; i < x.size(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          if (i == j && (!layout.rotational() || layout.particles[i].on_axis))
            continue;
          const Point<dim>     b         = layout.nearest_image(x, i, j)(x[j]);
          const Tensor<1, dim> direction = (b - x[i]) / x[i].distance(b);
          const Point<dim>     begin =
            x[i] + layout.particles[i].radius * direction;
          const Point<dim> end = b - layout.particles[j].radius * direction;
          // wide gaps are resolved by the elements of the surfaces
          if (begin.distance(end) < layout.particles[i].radius &&
              elements_across<dim>(mesh, begin, end) <
                parameters.remesh_gap * parameters.mesh.elements_across_gap)
            return true;
        }
    return false;
  }



  template <int dim>
  void
  Remesher<dim>::choose_images(const Scene<dim>   &layout,
                               State<dim>         &state,
                               Configuration<dim> &next) const
  {
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      if (!layout.particles[i].on_axis)
        {
          const Image<dim> image = image_in_block(layout, next.centres[i]);
          replace_by_image(image, i, state);
          next.centres[i] = image(next.centres[i]);
        }
  }



  /**
   * Describe particle @p i by its image.
   */
  template <int dim>
  void
  Remesher<dim>::replace_by_image(const Image<dim>  &image,
                                  const unsigned int i,
                                  State<dim>        &state) const
  {
    for (Level<dim> *level : {&state.now, &state.before})
      if (!level->configuration.centres.empty())
        {
          Point<dim> &centre = level->configuration.centres[i];
          centre             = image(centre);
          if (level->flow.motions.empty())
            continue;
          RigidMotion<dim> &motion = level->flow.motions[i];
          motion.velocity          = image.turn(motion.velocity);
          motion.angular_velocity =
            Image<3>{image.turned}.turn(motion.angular_velocity);
        }

    const RigidBodies<dim> bodies(scene);
    const auto             range = bodies.range(i);
    for (unsigned int k = range.first; k < range.second; ++k)
      if (image.turned && bodies.unknown(k).axis < 2)
        state.holding_forces[k] *= -1.;
  }



  template <int dim>
  void
  Remesher<dim>::remesh(State<dim> &state, Configuration<dim> &next) const
  {
    // on copies: if this fails all is as before
    Configuration<dim> fresh_next = next;
    State<dim>         fresh;
    fresh.now            = state.now;
    fresh.before         = state.before;
    fresh.last_dt        = state.last_dt;
    fresh.holding_forces = state.holding_forces;
    // lists of vectors are copied without ghost values
    for (Level<dim> *level : {&fresh.now, &fresh.before})
      for (VectorType &component : level->log_conformation)
        component.update_ghost_values();

    const Scene<dim> layout = layout_for(fresh_next);
    choose_images(layout, fresh, fresh_next);
    fresh.discretization                   = make(layout, fresh_next);
    MovingMesh<dim>       &mesh            = *fresh.discretization.mesh;
    const MovingMesh<dim> &old_mesh        = *state.discretization.mesh;
    const VectorType       final_positions = mesh.positions();

    for (Level<dim> *level : {&fresh.now, &fresh.before})
      {
        if (level->positions.size() == 0)
          continue;
        const VectorType positions =
          fresh.discretization.mover->positions(level->configuration);
        mesh.set_positions(positions);
        if (!(mesh.quality() > 0.))
          throw MeshError("The new mesh is inverted at an earlier instant.");
        const FieldTransfer<dim> transfer(old_mesh,
                                          level->positions,
                                          mesh,
                                          positions);
        replace_field(level->positions, positions);
        if (level->flow.velocity.size() > 0)
          {
            replace_field(level->flow.velocity,
                          transfer.vector(level->flow.velocity));
            replace_field(level->flow.pressure,
                          transfer.scalar(level->flow.pressure));
          }
        if (!level->log_conformation.empty())
          transfer_conformation(transfer,
                                mesh,
                                positions,
                                level->log_conformation,
                                level->unresolved_conformation);
      }
    mesh.set_positions(final_positions);
    // no field of the old mesh is assigned to, see replace_field()
    state = State<dim>();
    state = std::move(fresh);
    next  = fresh_next;
  }



  template <int dim>
  double
  elements_across(const MovingMesh<dim> &mesh,
                  const Point<dim>      &begin,
                  const Point<dim>      &end)
  {
    const double         width     = begin.distance(end);
    const Tensor<1, dim> direction = (end - begin) / width;

    // chords of the segment through the (straight-sided) cells
    double chords = 0., weighted_extents = 0.;
    for (const auto &cell : mesh.cells())
      {
        if (!cell.owned)
          continue;
        const auto     nodes = mesh.cell_positions(cell, mesh.positions());
        Tensor<2, dim> edges;
        double         lowest = 0., highest = 0.;
        for (unsigned int v = 1; v <= dim; ++v)
          {
            const Tensor<1, dim> edge = nodes[v] - nodes[0];
            for (unsigned int d = 0; d < dim; ++d)
              edges[d][v - 1] = edge[d];
            lowest  = std::min(lowest, edge * direction);
            highest = std::max(highest, edge * direction);
          }
        const double along = (nodes[0] - begin) * direction;
        if (along + highest < 0. || along + lowest > width)
          continue;

        // barycentric coordinates along the segment: base + t slope >= 0
        const Tensor<2, dim> inverse = invert(edges);
        Tensor<1, dim>       base    = inverse * (begin - nodes[0]),
                       slope         = inverse * direction;
        double     enter = 0., leave = width, base_0 = 1., slope_0 = 0.;
        const auto clip = [&](const double b, const double s) {
          if (s > 0.)
            enter = std::max(enter, -b / s);
          else if (s < 0.)
            leave = std::min(leave, -b / s);
          else if (b < 0.)
            leave = -1.;
        };
        for (unsigned int d = 0; d < dim; ++d)
          {
            clip(base[d], slope[d]);
            base_0 -= base[d];
            slope_0 -= slope[d];
          }
        clip(base_0, slope_0);
        if (leave > enter)
          {
            chords += leave - enter;
            weighted_extents += (leave - enter) * (highest - lowest);
          }
      }
    chords = Utilities::MPI::sum(chords, mesh.communicator());
    weighted_extents =
      Utilities::MPI::sum(weighted_extents, mesh.communicator());
    return weighted_extents > 0. ? width * chords / weighted_extents :
                                   std::numeric_limits<double>::max();
  }



  template class Remesher<2>;
  template class Remesher<3>;
  template double
  elements_across<2>(const MovingMesh<2> &, const Point<2> &, const Point<2> &);
  template double
  elements_across<3>(const MovingMesh<3> &, const Point<3> &, const Point<3> &);
} // namespace Catena

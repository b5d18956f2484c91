#include <catena/base/exceptions.h>
#include <catena/mesh/field_transfer.h>
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
        catch (const MeshError &error)
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
  Remesher<dim>::scene_at(const Configuration<dim> &configuration) const
  {
    Scene<dim> layout = scene;
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      layout.particles[i].centre = configuration.centres[i];
    if (!layout.rotational())
      return layout;

    // cut along the plane that is farther from the particles beside the axis
    double x = std::numeric_limits<double>::max(), y = x, mean_x = 0.;
    for (const Particle<dim> &p : layout.particles)
      if (!p.on_axis)
        {
          x      = std::min({x,
                             std::abs(p.centre[0]),
                             scene.length / 2. - std::abs(p.centre[0])});
          y      = std::min(y, std::abs(p.centre[1]));
          mean_x = p.centre[0];
        }
    layout.cut = x >= y ? Cut::x_plane : Cut::y_plane;
    if (layout.cut == Cut::y_plane)
      {
        // keep the ends of the period away from the particle

        layout.window_centre =
          std::abs(mean_x) < scene.length / 8. ? 0. : mean_x / 2.;
      }
    return layout;
  }



  template <int dim>
  Discretization<dim>
  Remesher<dim>::make(const Configuration<dim> &configuration) const
  {
    const Configuration<dim> reference = rounded(configuration);
    const Scene<dim>         layout    = scene_at(reference);

    Discretization<dim> result;
    result.mesh = std::make_unique<MovingMesh<dim>>(
      communicator,
      layout,
      mesh_on_all_ranks<dim>(layout, parameters.mesh, communicator));
    result.mover = std::make_unique<MeshMover<dim>>(*result.mesh, reference);
    result.initial_quality = result.mesh->quality();
    result.mesh->set_positions(result.mover->positions(configuration));
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
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        {
          const Point<dim>    &a         = configuration.centres[i];
          const Point<dim>    &b         = configuration.centres[j];
          const Tensor<1, dim> direction = (b - a) / a.distance(b);
          if (elements_across<dim>(mesh,
                                   a + layout.particles[i].radius * direction,
                                   b - layout.particles[j].radius * direction) <
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
    const Point<dim> low = layout.lower(), high = layout.upper();
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      {
        if (layout.particles[i].on_axis)
          continue;
        const auto inside = [&](const Point<dim> &p) {
          return p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] &&
                 p[1] <= high[1];
        };
        if (inside(next.centres[i]))
          continue;

        const auto images = layout.rotated_images(next.centres[i]);
        for (unsigned int k = 1; k < images.size(); ++k)
          if (inside(images[k]))
            {
              const bool turned = layout.rotational() && k % 2 == 1;
              for (Level<dim> *level : {&state.now, &state.before})
                if (!level->configuration.centres.empty())
                  {
                    Point<dim> &centre = level->configuration.centres[i];
                    centre             = layout.rotated_images(centre)[k];
                    if (turned && !level->flow.motions.empty())
                      for (unsigned int d = 0; d < 2; ++d)
                        {
                          level->flow.motions[i].velocity[d] *= -1.;
                          level->flow.motions[i].angular_velocity[d] *= -1.;
                        }
                  }
              next.centres[i] = images[k];
              break;
            }
      }
  }



  template <int dim>
  void
  Remesher<dim>::remesh(State<dim> &state, Configuration<dim> &next) const
  {
    choose_images(scene_at(next), state, next);
    Discretization<dim>    fresh = make(next);
    const MovingMesh<dim> &mesh  = *state.discretization.mesh;

    for (Level<dim> *level : {&state.now, &state.before})
      {
        if (level->positions.size() == 0)
          continue;
        const VectorType positions =
          fresh.mover->positions(level->configuration);
        const FieldTransfer<dim> transfer(mesh,
                                          level->positions,
                                          *fresh.mesh,
                                          positions);
        level->positions = positions;
        if (level->flow.velocity.size() > 0)
          {
            level->flow.velocity = transfer.vector(level->flow.velocity);
            level->flow.pressure = transfer.scalar(level->flow.pressure);
          }
        if (!level->log_conformation.empty())
          level->log_conformation = transfer.tensor(level->log_conformation);
      }
    state.discretization = std::move(fresh);
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

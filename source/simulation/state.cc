#include <catena/simulation/state.h>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  void
  Discretization<dim>::archive(Archive          &archive,
                               const Scene<dim> &scene,
                               const MPI_Comm    communicator)
  {
    const bool           loading = archive.is_loading();
    MeshDescription<dim> description;
    Scene<dim>           layout = scene;
    Configuration<dim>   reference;
    if (!loading)
      {
        description = mesh->description();
        layout      = mesh->scene();
        reference   = mover->reference_configuration();
      }
    archive(layout.cut,
            layout.window_centre,
            reference,
            initial_quality,
            description);
    if (!loading)
      return;

    if (reference.centres.size() != layout.particles.size())
      throw CheckpointError("it has " +
                            std::to_string(reference.centres.size()) +
                            " particles, there should be " +
                            std::to_string(layout.particles.size()));
    for (unsigned int i = 0; i < layout.particles.size(); ++i)
      layout.particles[i].centre = reference.centres[i];
    mover.reset();
    try
      {
        mesh =
          std::make_unique<MovingMesh<dim>>(communicator, layout, description);
      }
    catch (const MeshError &error)
      {
        throw CheckpointError("its mesh is damaged. " +
                              std::string(error.what()));
      }
    if (!(mesh->quality() > 0.))
      throw CheckpointError("its mesh is inverted");
    mover = std::make_unique<MeshMover<dim>>(*mesh, reference);
  }



  template <int dim>
  void
  Level<dim>::archive(FieldArchive<dim> &archive)
  {
    archive(time, configuration, is_balanced);
    archive.vector(positions);
    archive.vector(flow.velocity);
    archive.scalar(flow.pressure);
    archive(flow.motions,
            flow.contact_forces,
            flow.pressure_drop,
            flow.reactions);
    archive.scalars(log_conformation);
    archive.points(unresolved_conformation);
  }



  template <int dim>
  void
  State<dim>::archive(Archive          &archive,
                      const Scene<dim> &scene,
                      const MPI_Comm    communicator)
  {
    if (archive.is_loading())
      *this = State<dim>();
    discretization.archive(archive, scene, communicator);
    FieldArchive<dim> fields(archive, *discretization.mesh);
    discretization.mover->archive(fields);
    now.archive(fields);
    before.archive(fields);
    fields(last_dt, holding_forces);
    if (archive.is_loading())
      {
        if (now.positions.size() == 0 ||
            now.configuration.centres.size() != scene.particles.size())
          throw CheckpointError("it has no present state");
        discretization.mesh->set_positions(now.positions);
      }
  }



  template struct Discretization<2>;
  template struct Discretization<3>;
  template struct Level<2>;
  template struct Level<3>;
  template struct State<2>;
  template struct State<3>;
} // namespace Catena

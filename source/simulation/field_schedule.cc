#include <catena/rheology/giesekus.h>
#include <catena/simulation/field_schedule.h>

#include <algorithm>

namespace Catena
{
  using namespace dealii;

  template <int dim>
  FieldSchedule<dim>::FieldSchedule(const SimulationParameters &parameters,
                                    const std::string          &directory,
                                    const MPI_Comm              communicator)
    : strains(parameters.field_strains)
    , modulus(parameters.viscoelastic() ?
                Giesekus<dim>(parameters.fluid.giesekus).modulus() :
                0.)
    , output(directory, "fields", communicator)
  {
    std::sort(strains.begin(), strains.end());
  }



  /// Step over all strains up to @p strain. @return whether there are any
  template <int dim>
  bool
  FieldSchedule<dim>::pass(const double strain)
  {
    const unsigned int before = next;
    while (next < strains.size() &&
           strains[next] <= strain + ShearProtocol::same_strain)
      ++next;
    return next > before;
  }



  template <int dim>
  void
  FieldSchedule<dim>::write_if_due(Simulation<dim> &simulation)
  {
    if (!pass(simulation.strain()))
      return;
    const auto        timer = simulation.report().time("output");
    const Level<dim> &now   = simulation.current_state().now;
    const auto       &mesh  = simulation.mesh();
    output.write(now.time,
                 mesh.mapping(),
                 mesh.vector_dofs(),
                 now.flow.velocity,
                 mesh.scalar_dofs(),
                 now.flow.pressure,
                 now.log_conformation,
                 modulus);
  }



  template <int dim>
  void
  FieldSchedule<dim>::archive(Archive &archive, const double strain)
  {
    std::vector<double>      at;
    std::vector<std::string> names;
    for (const auto &record : output.records())
      {
        at.push_back(record.first);
        names.push_back(record.second);
      }
    archive(at, names);
    if (!archive.is_loading())
      return;
    if (at.size() != names.size())
      throw CheckpointError("it has fields without a name");
    std::vector<std::pair<double, std::string>> records;
    for (unsigned int i = 0; i < at.size(); ++i)
      records.emplace_back(at[i], names[i]);
    output.continue_after(records);
    pass(strain);
  }



  template class FieldSchedule<2>;
  template class FieldSchedule<3>;
} // namespace Catena

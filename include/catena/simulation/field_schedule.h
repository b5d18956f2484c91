#ifndef catena_simulation_field_schedule_h
#define catena_simulation_field_schedule_h

#include <catena/output/field_output.h>
#include <catena/simulation/simulation.h>

#include <string>
#include <vector>

namespace Catena
{
  /**
   * Writes the fields once for each strain asked for. The steps of a Simulation
   * end there; what is asked for before its start is written there.
   */
  template <int dim>
  class FieldSchedule
  {
  public:
    FieldSchedule(const SimulationParameters &parameters,
                  const std::string          &directory,
                  const MPI_Comm              communicator);

    void
    write_if_due(Simulation<dim> &simulation);

    /**
     * Save what has been written, or go on after that from @p strain. What is
     * asked for at strains before is not written any more.
     */
    void
    archive(Archive &archive, const double strain);

  private:
    std::vector<double> strains;
    const double        modulus;
    FieldOutput<dim>    output;
    unsigned int        next = 0;

    bool
    pass(const double strain);
  };
} // namespace Catena

#endif

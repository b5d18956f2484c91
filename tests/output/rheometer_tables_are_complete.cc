// The tables of the rheometer for a Giesekus, an Oldroyd-B and a Carreau
// fluid at a few rates and times, word for word. Oldroyd-B has no steady
// extension at Wi = 1.

#include <catena/output/rheometer_tables.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iostream>

using namespace Catena;

RheometerParameters
make_parameters(const FluidParameters::Model model, const double alpha)
{
  RheometerParameters parameters;
  parameters.fluid.model                       = model;
  parameters.fluid.giesekus.mobility_parameter = alpha;
  parameters.lowest_rate                       = 0.1;
  parameters.highest_rate                      = 1.;
  parameters.n_rates                           = 3;
  parameters.start_up_rates                    = {0.5, 1.};
  parameters.first_time                        = 0.1;
  parameters.last_time                         = 10.;
  parameters.n_times                           = 3;
  return parameters;
}



void
record(const std::string         &fluid,
       const RheometerParameters &parameters,
       std::ostream              &output)
{
  write_rheometer_tables(parameters, fluid, false, MPI_COMM_WORLD);
  for (const std::string &curve : parameters.curves)
    {
      std::ifstream table(fluid + "/" + curve + ".csv");
      output << fluid << ' ' << curve << '\n' << table.rdbuf();
    }
}



int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                                  output("output");

  using Model = FluidParameters::Model;
  record("giesekus", make_parameters(Model::giesekus, 0.2), output);
  record("oldroyd_b", make_parameters(Model::giesekus, 0.), output);

  RheometerParameters carreau = make_parameters(Model::carreau, 0.);
  carreau.curves              = {"steady_shear", "steady_extension"};
  record("carreau", carreau, output);
  return 0;
}

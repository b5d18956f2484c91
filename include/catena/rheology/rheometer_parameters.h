#ifndef catena_rheology_rheometer_parameters_h
#define catena_rheology_rheometer_parameters_h

#include <catena/rheology/fluid_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Catena
{
  /**
   * What a rheometer measures. Rates are in units of gamma, times in units of
   * 1/gamma.
   */
  struct RheometerParameters
  {
    FluidParameters fluid;

    /// The rates of steady shear and extension, evenly spaced in their
    /// logarithm.
    double       lowest_rate  = 0.01;
    double       highest_rate = 100.;
    unsigned int n_rates      = 41;

    /// The rates of start-up.
    std::vector<double> start_up_rates = {0.1, 1., 10.};

    /// The times of start-up, evenly spaced in their logarithm.
    double       first_time = 0.01;
    double       last_time  = 20.;
    unsigned int n_times    = 61;

    /// Any of "steady_shear", "start_up_shear", "steady_extension" and
    /// "start_up_extension", the names of the tables.
    std::vector<std::string> curves = {"steady_shear",
                                       "start_up_shear",
                                       "steady_extension",
                                       "start_up_extension"};

    std::string output_directory = "results";

    /**
     * Declare the sections "Fluid", "Steady flow", "Start-up" and "Output" in
     * @p prm. Parsing @p prm fills this object, which must outlive @p prm.
     */
    void
    declare(dealii::ParameterHandler &prm);

    /**
     * @throws InputError if a parameter cannot be used.
     */
    void
    check() const;

    /// The rates of steady flow, lowest_rate first.
    std::vector<double>
    rates() const;

    /// The times of start-up, first_time first.
    std::vector<double>
    times() const;

    /// Whether @p curve is among the curves asked for.
    bool
    wants(const std::string &curve) const;
  };
} // namespace Catena

#endif

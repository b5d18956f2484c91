#include <catena/base/exceptions.h>
#include <catena/rheology/rheometer_parameters.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// The names of all curves, as Patterns::Selection takes them.
    constexpr char curve_names[] = "steady_shear|start_up_shear|"
                                   "steady_extension|start_up_extension";



    /**
     * @p n >= 2 values from @p first to @p last, both exact, whose logarithms
     * are evenly spaced.
     */
    std::vector<double>
    logarithmic_range(const double       first,
                      const double       last,
                      const unsigned int n)
    {
      std::vector<double> values(n, first);
      for (unsigned int k = 1; k + 1 < n; ++k)
        values[k] =
          std::pow(10.,
                   ((n - 1 - k) * std::log10(first) + k * std::log10(last)) /
                     (n - 1));
      values.back() = last;
      return values;
    }



    void
    check_range(const std::string &first_name,
                const double       first,
                const std::string &last_name,
                const double       last)
    {
      require(first > 0. && std::isfinite(first),
              first_name,
              first,
              "choose a positive, finite value");
      require(last > first && std::isfinite(last),
              last_name,
              last,
              "choose a finite value above '" + first_name + "'");
    }
  } // namespace



  void
  RheometerParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Fluid");
    fluid.declare(prm);
    prm.leave_subsection();

    prm.enter_subsection("Steady flow");
    prm.add_parameter("Lowest rate",
                      lowest_rate,
                      "The lowest rate of steady shear and steady extension "
                      "[gamma]. With a Weissenberg number of 1 the rate is the "
                      "Weissenberg number of the flow.",
                      Patterns::Double());
    prm.add_parameter("Highest rate",
                      highest_rate,
                      "The highest rate [gamma].",
                      Patterns::Double());
    prm.add_parameter("Number of rates",
                      n_rates,
                      "Number of rates, the lowest and the highest included, "
                      "evenly spaced in their logarithm.",
                      Patterns::Integer(2));
    prm.leave_subsection();

    prm.enter_subsection("Start-up");
    prm.add_parameter("Rates",
                      start_up_rates,
                      "The rates at which shear and extension start from rest "
                      "[gamma], separated by commas.");
    prm.add_parameter("First time",
                      first_time,
                      "The first time after the start [1/gamma].",
                      Patterns::Double());
    prm.add_parameter("Last time",
                      last_time,
                      "The last time after the start [1/gamma].",
                      Patterns::Double());
    prm.add_parameter("Number of times",
                      n_times,
                      "Number of times, the first and the last included, "
                      "evenly spaced in their logarithm.",
                      Patterns::Integer(2));
    prm.leave_subsection();

    prm.enter_subsection("Output");
    prm.add_parameter("Directory", output_directory, "Folder of the results.");
    prm.add_parameter("Curves",
                      curves,
                      "The tables to write, separated by commas.",
                      Patterns::List(Patterns::Selection(curve_names), 1, 4));
    prm.leave_subsection();
  }



  void
  RheometerParameters::check() const
  {
    fluid.check();
    require(!curves.empty(),
            "Output/Curves",
            "(none)",
            "name one curve at least, --template lists them");
    for (const std::string &curve : curves)
      require(Patterns::Selection(curve_names).match(curve),
              "Output/Curves",
              curve,
              "no such curve, --template lists them");
    check_range("Steady flow/Lowest rate",
                lowest_rate,
                "Steady flow/Highest rate",
                highest_rate);
    require(n_rates >= 2,
            "Steady flow/Number of rates",
            n_rates,
            "give a number of at least 2");
    require(n_times >= 2,
            "Start-up/Number of times",
            n_times,
            "give a number of at least 2");
    require(!start_up_rates.empty() ||
              !(wants("start_up_shear") || wants("start_up_extension")),
            "Start-up/Rates",
            "(none)",
            "name one rate at least; to have no start-up leave it out "
            "of 'Output/Curves'");
    for (const double rate : start_up_rates)
      require(rate > 0. && std::isfinite(rate),
              "Start-up/Rates",
              rate,
              "choose positive, finite rates");
    check_range("Start-up/First time",
                first_time,
                "Start-up/Last time",
                last_time);
  }



  std::vector<double>
  RheometerParameters::rates() const
  {
    return logarithmic_range(lowest_rate, highest_rate, n_rates);
  }



  std::vector<double>
  RheometerParameters::times() const
  {
    return logarithmic_range(first_time, last_time, n_times);
  }



  bool
  RheometerParameters::wants(const std::string &curve) const
  {
    return std::find(curves.begin(), curves.end(), curve) != curves.end();
  }
} // namespace Catena

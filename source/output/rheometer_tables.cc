#include <catena/base/program_options.h>
#include <catena/output/rheometer_tables.h>
#include <catena/output/trajectory_table.h>
#include <catena/rheology/rheometer.h>

#include <iostream>
#include <limits>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Significant digits of the tables.
    constexpr unsigned int n_digits = 16;



    /**
     * One curve of one fluid: a table, and a line on the standard output once
     * it is complete.
     */
    class CurveTable
    {
    public:
      enum class Flow
      {
        shear,
        extension
      };

      CurveTable(const Rheometer   &rheometer,
                 const std::string &directory,
                 const std::string &name,
                 const Flow         flow,
                 const MPI_Comm     communicator)
        : rheometer(rheometer)
        , name(name)
        , flow(flow)
        , is_writer(Utilities::MPI::this_mpi_process(communicator) == 0)
        , table(directory + "/" + name + ".csv", communicator, n_digits)
      {
        table.declare("rate", "gamma");
        table.declare("Wi");
      }

      /**
       * Write @p function(rate) for each of @p rates.
       */
      template <typename Function>
      void
      write_steady(const std::vector<double> &rates, const Function &function)
      {
        declare_functions();
        for (const double rate : rates)
          {
            add_rate(rate);
            add(function(rate));
            table.write_row();
          }
        report();
      }

      /**
       * Write @p function(rate, times), which has a value for each of
       * @p times, for each of @p rates.
       */
      template <typename Function>
      void
      write_start_up(const std::vector<double> &rates,
                     const std::vector<double> &times,
                     const Function            &function)
      {
        table.declare("time", "1/gamma");
        table.declare("strain");
        declare_functions();
        for (const double rate : rates)
          {
            const auto curve = function(rate, times);
            for (unsigned int n = 0; n < times.size(); ++n)
              {
                add_rate(rate);
                table.add("time", times[n]);
                table.add("strain", rate * times[n]);
                add(curve[n]);
                table.write_row();
              }
          }
        report();
      }

    private:
      const Rheometer  &rheometer;
      const std::string name;
      const Flow        flow;
      const bool        is_writer;
      TrajectoryTable   table;
      unsigned int      n_unsteady = 0;

      void
      declare_functions()
      {
        if (flow == Flow::extension)
          {
            table.declare("extensional_viscosity", "eta0");
            return;
          }
        table.declare("viscosity", "eta0");
        table.declare("N1", "eta0 gamma");
        table.declare("N2", "eta0 gamma");
        table.declare("S");
      }

      void
      add_rate(const double rate)
      {
        table.add("rate", rate);
        table.add("Wi", rheometer.weissenberg_number(rate));
      }

      void
      add(const ShearFunctions &functions)
      {
        table.add("viscosity", functions.viscosity);
        table.add("N1", functions.first_normal_stress_difference);
        table.add("N2", functions.second_normal_stress_difference);
        table.add("S", functions.elasticity_parameter);
      }

      void
      add(const std::optional<double> &viscosity)
      {
        n_unsteady += viscosity ? 0 : 1;
        table.add("extensional_viscosity",
                  viscosity.value_or(std::numeric_limits<double>::quiet_NaN()));
      }

      void
      report() const
      {
        if (!is_writer)
          return;
        std::cout << name << ".csv: " << table.n_rows() << " rows";
        if (n_unsteady > 0)
          std::cout << ", " << n_unsteady << " without a steady state";
        std::cout << std::endl;
      }
    };
  } // namespace



  void
  write_rheometer_tables(const RheometerParameters &parameters,
                         const std::string         &directory,
                         const bool                 overwrite,
                         const MPI_Comm             communicator)
  {
    parameters.check();
    const Rheometer rheometer(parameters.fluid);
    prepare_output_directory(directory, overwrite, communicator);

    using Flow       = CurveTable::Flow;
    using Times      = std::vector<double>;
    const auto table = [&](const std::string &name, const Flow flow) {
      return CurveTable(rheometer, directory, name, flow, communicator);
    };

    if (parameters.wants("steady_shear"))
      table("steady_shear", Flow::shear)
        .write_steady(parameters.rates(), [&](const double rate) {
          return rheometer.steady_shear(rate);
        });

    if (parameters.wants("start_up_shear"))
      table("start_up_shear", Flow::shear)
        .write_start_up(parameters.start_up_rates,
                        parameters.times(),
                        [&](const double rate, const Times &times) {
                          return rheometer.start_up_shear(rate, times);
                        });

    if (parameters.wants("steady_extension"))
      table("steady_extension", Flow::extension)
        .write_steady(parameters.rates(), [&](const double rate) {
          return rheometer.steady_extension(rate);
        });

    if (parameters.wants("start_up_extension"))
      table("start_up_extension", Flow::extension)
        .write_start_up(parameters.start_up_rates,
                        parameters.times(),
                        [&](const double rate, const Times &times) {
                          return rheometer.start_up_extension(rate, times);
                        });
  }
} // namespace Catena

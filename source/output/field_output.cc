#include <catena/base/exceptions.h>
#include <catena/base/whole_file.h>
#include <catena/mesh/cell_fields.h>
#include <catena/output/field_output.h>
#include <catena/rheology/spectral.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/utilities.h>

#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <tuple>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /**
     * DataOut that can join scalar data sets given one by one into tensors.
     */
    template <int dim>
    class TensorDataOut : public DataOut<dim>
    {
    public:
      using Range =
        std::tuple<unsigned int,
                   unsigned int,
                   std::string,
                   DataComponentInterpretation::DataComponentInterpretation>;

      /**
       * Add the tensor @p name, whose components, row by row, are given on
       * @p dofs.
       */
      void
      add_tensor(const DoFHandler<dim>         &dofs,
                 const std::vector<VectorType> &components,
                 const std::string             &name)
      {
        AssertDimension(components.size(), dim * dim);
        tensor_names.push_back(name);
        for (unsigned int c = 0; c < components.size(); ++c)
          this->add_data_vector(dofs,
                                components[c],
                                name + "_" + std::to_string(c / dim) +
                                  std::to_string(c % dim));
      }

      std::vector<Range>
      get_nonscalar_data_ranges() const override
      {
        std::vector<Range> ranges = DataOut<dim>::get_nonscalar_data_ranges();
        const std::vector<std::string> names = this->get_dataset_names();
        for (const std::string &tensor : tensor_names)
          {
            const auto first =
              std::find(names.begin(), names.end(), tensor + "_00");
            Assert(first != names.end(), ExcInternalError());
            const unsigned int begin = first - names.begin();
            ranges.emplace_back(
              begin,
              begin + dim * dim - 1,
              tensor,
              DataComponentInterpretation::component_is_part_of_tensor);
          }
        return ranges;
      }

    private:
      std::vector<std::string> tensor_names;
    };



    /**
     * Nodal values of the conformation and what follows from it.
     */
    template <int dim>
    struct Stresses
    {
      std::vector<VectorType> conformation;
      std::vector<VectorType> tau;
      VectorType              trace_tau_over_modulus;

      Stresses(const std::vector<VectorType> &log_conformation,
               const double                   modulus,
               const MPI_Comm                 communicator);
    };



    template <int dim>
    Stresses<dim>::Stresses(const std::vector<VectorType> &log_conformation,
                            const double                   modulus,
                            const MPI_Comm                 communicator)
    {
      AssertDimension(log_conformation.size(), n_symmetric_components(dim));

      const IndexSet owned = log_conformation[0].locally_owned_elements();
      trace_tau_over_modulus.reinit(owned, communicator);
      conformation.assign(dim * dim, trace_tau_over_modulus);
      tau = conformation;

      for (const auto node : owned)
        {
          const SymmetricTensor<2, dim> c = exponential(
            spectral_decomposition(vertex_tensor<dim>(node, log_conformation)));
          trace_tau_over_modulus(node) = trace(c) - dim;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                conformation[i * dim + j](node) = c[i][j];
                tau[i * dim + j](node) = modulus * (c[i][j] - (i == j));
              }
        }
    }



    /// @return whether that was possible, the same on all processes
    template <int dim>
    bool
    write_vtu(const TensorDataOut<dim> &data_out,
              const std::string        &path,
              const MPI_Comm            communicator)
    {
      const bool alone = Utilities::MPI::n_mpi_processes(communicator) == 1;
      int        error = 0;
      try
        {
          if (alone)
            error = WholeFile::write(path, [&](std::ostream &file) {
              data_out.write_vtu(file);
            });
          else
            data_out.write_vtu_in_parallel(WholeFile::draft(path),
                                           communicator);
        }
      catch (const ExcIO &)
        {
          error = EIO;
        }
      catch (const ExcMPI &)
        {
          error = EIO;
        }
      error = Utilities::MPI::max(error, communicator);
      if (!alone && error == 0 &&
          Utilities::MPI::this_mpi_process(communicator) == 0)
        error = WholeFile::publish(path);
      return Utilities::MPI::broadcast(communicator, error) == 0;
    }



    DataOutBase::VtkFlags
    vtk_flags(const double strain)
    {
      DataOutBase::VtkFlags flags;
      flags.time                     = strain;
      flags.compression_level        = DataOutBase::VtkFlags::best_speed;
      flags.write_higher_order_cells = false;
      flags.physical_units           = {{"velocity", "gamma a"},
                                        {"pressure", "eta0 gamma"},
                                        {"tau", "eta0 gamma"}};
      return flags;
    }
  } // namespace



  template <int dim>
  FieldOutput<dim>::FieldOutput(const std::string &directory,
                                const std::string &basename,
                                const MPI_Comm     communicator)
    : directory(directory)
    , basename(basename)
    , communicator(communicator)
  {
    const std::string folder = directory + "/" + basename;
    std::error_code   error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::filesystem::create_directories(folder, error);

    const std::string message =
      Utilities::MPI::broadcast(communicator,
                                error ? error.message() : std::string(),
                                0);
    if (!message.empty())
      throw Error("Directory '" + folder + "' cannot be made: " + message +
                  ".");
  }



  template <int dim>
  void
  FieldOutput<dim>::write(const double                   strain,
                          const Mapping<dim>            &mapping,
                          const DoFHandler<dim>         &vector_dofs,
                          const VectorType              &velocity,
                          const DoFHandler<dim>         &scalar_dofs,
                          const VectorType              &pressure,
                          const std::vector<VectorType> &log_conformation,
                          const double                   modulus)
  {
    std::optional<Stresses<dim>> stresses;
    TensorDataOut<dim>           data_out;
    data_out.set_flags(vtk_flags(strain));

    data_out.add_data_vector(
      vector_dofs,
      velocity,
      std::vector<std::string>(dim, "velocity"),
      std::vector<DataComponentInterpretation::DataComponentInterpretation>(
        dim, DataComponentInterpretation::component_is_part_of_vector));
    data_out.add_data_vector(scalar_dofs, pressure, "pressure");

    if (!log_conformation.empty())
      {
        stresses.emplace(log_conformation, modulus, communicator);
        data_out.add_tensor(scalar_dofs,
                            stresses->conformation,
                            "conformation");
        data_out.add_tensor(scalar_dofs, stresses->tau, "tau");
        data_out.add_data_vector(scalar_dofs,
                                 stresses->trace_tau_over_modulus,
                                 "trace_tau_over_G");
      }

    // Two subdivisions of a simplex become one quadratic cell.
    data_out.build_patches(mapping, 2, DataOut<dim>::curved_inner_cells);

    const std::string name = basename + "/" + basename + "_" +
                             Utilities::int_to_string(files.size() + 1, 4) +
                             ".vtu";
    const std::string path = directory + "/" + name;
    if (!write_vtu(data_out, path, communicator))
      throw Error("File '" + path + "' cannot be written: is the disk full?");

    files.emplace_back(strain, name);
    write_record();
  }



  template <int dim>
  void
  FieldOutput<dim>::continue_after(
    const std::vector<std::pair<double, std::string>> &records)
  {
    files = records;
    if (!files.empty())
      write_record();
    else if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        // one that is not there is as good as removed
        std::error_code error;
        std::filesystem::remove(record(), error);
      }
  }



  template <int dim>
  const std::vector<std::pair<double, std::string>> &
  FieldOutput<dim>::records() const
  {
    return files;
  }



  template <int dim>
  std::string
  FieldOutput<dim>::record() const
  {
    return directory + "/" + basename + ".pvd";
  }



  template <int dim>
  void
  FieldOutput<dim>::write_record() const
  {
    const std::string path = record();

    int error = 0;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      error = WholeFile::write(path, [&](std::ostream &file) {
        file << "<?xml version=\"1.0\"?>\n"
             << "<VTKFile type=\"Collection\" version=\"0.1\">\n"
             << "  <Collection>\n";
        file.precision(12);
        for (const auto &[strain, name] : files)
          file << "    <DataSet timestep=\"" << strain
               << "\" group=\"\" part=\"0\" file=\"" << name << "\"/>\n";
        file << "  </Collection>\n</VTKFile>\n";
      });

    if (Utilities::MPI::broadcast(communicator, error) != 0)
      throw Error("File '" + path + "' cannot be written: is the disk full?");
  }



  template class FieldOutput<2>;
  template class FieldOutput<3>;
} // namespace Catena

// The fields of a run are written on quadratic simplices with the values they
// have, tensors row by row; the PVD file lists them with their strains.

#include <catena/base/exceptions.h>
#include <catena/output/field_output.h>

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/utilities.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/numerics/vector_tools.h>

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  const std::string directory = "field_output_test";

  std::string
  content(const std::string &name)
  {
    std::ifstream     file(name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }



  /**
   * The values of a data array; @p text begins with its first line.
   */
  template <typename T>
  std::vector<T>
  decode(const std::string &text)
  {
    // Four integers in base 64, of which the second is the size of the data
    // and the fourth the size of what follows.
    const std::string coded =
      dealii::Utilities::trim(text.substr(0, text.find("</DataArray>")));
    const auto    head = dealii::Utilities::decode_base64(coded.substr(0, 24));
    const auto    body = dealii::Utilities::decode_base64(coded.substr(24));
    std::uint32_t sizes[4];
    std::memcpy(sizes, head.data(), sizeof(sizes));

    std::vector<T> values(sizes[1] / sizeof(T));
    uLongf         size = sizes[1];
    uncompress(reinterpret_cast<Bytef *>(values.data()),
               &size,
               body.data(),
               sizes[3]);
    return values;
  }



  /**
   * The values of the data arrays of all pieces whose tag holds @p mark.
   */
  template <typename T>
  std::vector<T>
  array(const std::string &vtu, const std::string &mark)
  {
    std::vector<T> values;
    std::size_t    at = vtu.find(mark);
    while (at != std::string::npos)
      {
        at               = vtu.find('\n', at + mark.size()) + 1;
        const auto piece = decode<T>(vtu.substr(at));
        values.insert(values.end(), piece.begin(), piece.end());
        at = vtu.find(mark, at);
      }
    return values;
  }



  /**
   * Fields that quadratic and linear elements hold exactly, and the
   * log-conformation log(c) of a shear in the xy-plane that grows with x.
   */
  template <int dim>
  struct Fields
  {
    dealii::parallel::shared::Triangulation<dim> triangulation;
    dealii::MappingFE<dim>                       mapping;
    dealii::DoFHandler<dim>                      vector_dofs, scalar_dofs;
    VectorType                                   velocity, pressure;
    std::vector<VectorType>                      log_conformation;

    Fields();
  };



  /// Eigenvalues of c are exp(x) and exp(-x), its axes are at 45 degrees.
  template <int dim>
  Fields<dim>::Fields()
    : triangulation(MPI_COMM_WORLD)
    , mapping(dealii::FE_SimplexP<dim>(2))
    , vector_dofs(triangulation)
    , scalar_dofs(triangulation)
  {
    using namespace dealii;

    GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 1);
    vector_dofs.distribute_dofs(FESystem<dim>(FE_SimplexP<dim>(2), dim));
    scalar_dofs.distribute_dofs(FE_SimplexP<dim>(1));

    velocity.reinit(vector_dofs.locally_owned_dofs(),
                    DoFTools::extract_locally_relevant_dofs(vector_dofs),
                    MPI_COMM_WORLD);
    pressure.reinit(scalar_dofs.locally_owned_dofs(),
                    DoFTools::extract_locally_relevant_dofs(scalar_dofs),
                    MPI_COMM_WORLD);
    std::vector<std::function<double(const Point<dim> &)>> components(
      dim, [](const Point<dim> &) { return 0.; });
    components[0] = [](const Point<dim> &x) { return x[1] * x[1]; };
    VectorTools::interpolate(mapping,
                             vector_dofs,
                             FunctionFromFunctionObjects<dim>(components),
                             velocity);

    const ScalarFunctionFromFunctionObject<dim> x_coordinate(
      [](const Point<dim> &x) { return x[0]; });
    VectorTools::interpolate(mapping, scalar_dofs, x_coordinate, pressure);

    log_conformation.assign(n_symmetric_components(dim), pressure);
    for (VectorType &component : log_conformation)
      component = 0.;
    const unsigned int xy =
      SymmetricTensor<2, dim>::component_to_unrolled_index({0, 1});
    log_conformation[xy] = pressure;
  }



  /**
   * Largest deviation of the written fields from the exact ones.
   */
  template <int dim>
  void
  check_values(Tests::Claims &claims, const std::string &vtu)
  {
    const std::string dimension = std::to_string(dim) + "d: ";
    const auto        x         = array<float>(vtu, "<Points>\n    <DataArray");
    const auto u = array<float>(vtu, "\"velocity\" NumberOfComponents=\"3\"");
    const auto c =
      array<float>(vtu, "\"conformation\" NumberOfComponents=\"9\"");
    const auto tau    = array<float>(vtu, "\"tau\" NumberOfComponents=\"9\"");
    const auto trace  = array<float>(vtu, "\"trace_tau_over_G\"");
    const auto points = x.size() / 3;

    claims.holds(dimension + "vectors have 3 components, tensors 9",
                 points > 0 && u.size() == 3 * points &&
                   c.size() == 9 * points && tau.size() == 9 * points &&
                   trace.size() == points);

    double u_error = 0., c_error = 0., tau_error = 0., trace_error = 0.;
    for (std::size_t i = 0; i < points; ++i)
      {
        u_error =
          std::max(u_error,
                   std::abs(double(u[3 * i]) - x[3 * i + 1] * x[3 * i + 1]));

        // Linear in between the vertices, which are at x = 0 and 1.
        const double                  s = x[3 * i];
        dealii::SymmetricTensor<2, 3> exact;
        exact[0][0] = exact[1][1] = 1. + s * (std::cosh(1.) - 1.);
        exact[0][1]               = s * std::sinh(1.);
        exact[2][2]               = dim == 3 ? 1. : 0.;
        double sum                = -dim;
        for (unsigned int j = 0; j < 3; ++j)
          {
            sum += exact[j][j];
            for (unsigned int k = 0; k < 3; ++k)
              {
                const unsigned int index = 9 * i + 3 * j + k;
                const double       unit  = j == k && j < dim;
                c_error = std::max(c_error, std::abs(c[index] - exact[j][k]));
                tau_error =
                  std::max(tau_error,
                           std::abs(tau[index] - 0.3 * (exact[j][k] - unit)));
              }
          }
        trace_error = std::max(trace_error, std::abs(trace[i] - sum));
      }
    claims.at_most(dimension + "the velocity is exact", u_error, 1e-6);
    claims.at_most(dimension + "the conformation is exact", c_error, 1e-6);
    claims.at_most(dimension + "tau is exact", tau_error, 1e-6);
    claims.at_most(dimension + "the trace is exact", trace_error, 1e-6);
  }



  /**
   * Begin or end with no directory, on all processes.
   */
  void
  clear()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(directory);
    MPI_Barrier(MPI_COMM_WORLD);
  }



  /**
   * Write a viscoelastic and a Newtonian state, and fail to write a third.
   */
  template <int dim>
  bool
  third_is_refused(const Fields<dim> &fields)
  {
    FieldOutput<dim> output(directory, "fields", MPI_COMM_WORLD);
    const auto       write = [&](const double                   strain,
                           const std::vector<VectorType> &s) {
      output.write(strain,
                   fields.mapping,
                   fields.vector_dofs,
                   fields.velocity,
                   fields.scalar_dofs,
                   fields.pressure,
                   s,
                   0.3);
    };
    write(0.5, fields.log_conformation);
    write(1.25, {});

    std::filesystem::create_directory(directory + "/fields/fields_0003.vtu");
    MPI_Barrier(MPI_COMM_WORLD);
    try
      {
        write(2., {});
      }
    catch (const Error &error)
      {
        return std::string(error.what()).find("fields_0003.vtu") !=
               std::string::npos;
      }
    return false;
  }



  template <int dim>
  void
  check(Tests::Claims &claims)
  {
    const std::string dimension = std::to_string(dim) + "d: ";
    const Fields<dim> fields;

    clear();
    claims.holds(dimension + "a file that cannot be written is named",
                 third_is_refused(fields));

    const std::string vtu = content(directory + "/fields/fields_0001.vtu");
    check_values<dim>(claims, vtu);

    const auto types = array<std::uint8_t>(vtu, "\"types\"");
    claims.near(dimension + "all cells are written",
                types.size(),
                fields.triangulation.n_active_cells(),
                0.);
    const std::uint8_t quadratic = dim == 2 ? 22 : 24;
    claims.near(dimension + "all cells are quadratic",
                std::count(types.begin(), types.end(), quadratic),
                types.size(),
                0.);

    const std::string newtonian =
      content(directory + "/fields/fields_0002.vtu");
    claims.holds(dimension + "a Newtonian fluid has no stress field",
                 newtonian.find("pressure") != std::string::npos &&
                   newtonian.find("tau") == std::string::npos);

    const std::string pvd = content(directory + "/fields.pvd");
    claims.holds(dimension + "the PVD file lists the strains",
                 pvd.find("timestep=\"0.5\" group=\"\" part=\"0\" "
                          "file=\"fields/fields_0001.vtu\"") !=
                     std::string::npos &&
                   pvd.find("timestep=\"1.25\" group=\"\" part=\"0\" "
                            "file=\"fields/fields_0002.vtu\"") !=
                     std::string::npos);
    clear();
  }



  void
  test(Tests::Claims &claims)
  {
    check<2>(claims);
    check<3>(claims);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

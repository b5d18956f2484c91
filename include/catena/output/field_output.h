#ifndef catena_output_field_output_h
#define catena_output_field_output_h

#include <catena/base/types.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <string>
#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Write the fields of a run for ParaView or VisIt.
   *
   * Each call of write() makes one file
   * `directory/basename/basename_0001.vtu` and brings
   * `directory/basename.pvd`, the list of all files with their strains, up to
   * date. The cells are quadratic triangles or tetrahedra, whose mid-nodes lie
   * on the curved particles. Any number of processes share one file. All files
   * are WholeFile.
   *
   * | field            | shape     | unit       |                            |
   * |------------------|-----------|------------|----------------------------|
   * | velocity         | vector    | gamma a    |                            |
   * | pressure         | scalar    | eta0 gamma |                            |
   * | conformation     | tensor    |            | @f$c = \exp(s)@f$          |
   * | tau              | tensor    | eta0 gamma | @f$\tau = G (c - I)@f$     |
   * | trace_tau_over_G | scalar    |            | @f$\mathrm{tr}\,c - d@f$   |
   *
   * The last three appear for viscoelastic fluids only. They are computed at
   * the vertices from the log-conformation @f$s@f$ and linear in between, so
   * @f$c@f$ is positive definite everywhere. Tensors of two dimensions are
   * padded with zeros to 3 x 3, as VTK asks for.
   */
  template <int dim>
  class FieldOutput
  {
  public:
    /**
     * Prepare for output into @p directory, which exists. The subdirectory
     * @p basename is made if needed. Collective.
     *
     * @throws Error if it cannot be made.
     */
    FieldOutput(const std::string &directory,
                const std::string &basename,
                const MPI_Comm     communicator);

    /**
     * Write the fields of one instant. Collective.
     *
     * @param strain The label of this instant in the PVD file.
     * @param mapping The quadratic geometry.
     * @param vector_dofs Unknowns of the velocity, FESystem(FE_SimplexP(2)).
     * @param velocity The velocity, in gamma a.
     * @param scalar_dofs Unknowns of a scalar, FE_SimplexP(1).
     * @param pressure The pressure, in eta0 gamma.
     * @param log_conformation Components of @f$s = \log c@f$ in the order of
     *   dealii::SymmetricTensor (xx, yy, zz, xy, xz, yz or xx, yy, xy), each
     *   on @p scalar_dofs; empty for a Newtonian fluid.
     * @param modulus The modulus G, in eta0 gamma.
     *
     * @throws Error if a file cannot be written.
     */
    void
    write(const double                   strain,
          const dealii::Mapping<dim>    &mapping,
          const dealii::DoFHandler<dim> &vector_dofs,
          const VectorType              &velocity,
          const dealii::DoFHandler<dim> &scalar_dofs,
          const VectorType              &pressure,
          const std::vector<VectorType> &log_conformation,
          const double                   modulus);

    /**
     * Go on after the files of an earlier run, as records() gave them. The
     * list of files names these again and no others. Collective.
     */
    void
    continue_after(const std::vector<std::pair<double, std::string>> &records);

    /**
     * Strain and file name, relative to the directory, of all that has been
     * written.
     */
    const std::vector<std::pair<double, std::string>> &
    records() const;

  private:
    const std::string                           directory;
    const std::string                           basename;
    const MPI_Comm                              communicator;
    std::vector<std::pair<double, std::string>> files;

    /// The PVD file.
    std::string
    record() const;

    /**
     * Bring the PVD file up to date.
     */
    void
    write_record() const;
  };
} // namespace Catena

#endif

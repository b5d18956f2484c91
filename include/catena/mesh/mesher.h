#ifndef catena_mesh_mesher_h
#define catena_mesh_mesher_h

#include <catena/mesh/mesh_description.h>
#include <catena/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>

namespace Catena
{
  /**
   * Resolution and quality of the meshes. Lengths in particle radii a.
   */
  struct MeshParameters
  {
    /// n_part: elements along the equator of a particle, h = 2 pi a / n_part
    unsigned int elements_on_equator = 64;
    /// n_min: elements across a gap between particles
    unsigned int elements_across_gap = 2;
    /// how many times longer elements may be along a gap than across it
    double gap_stretch = 1.;
    /// growth of the element size per unit of distance from a particle at
    /// n_part = 64; the actual growth goes with n_part^(-2/3), at most 0.5
    double growth = 0.23;
    /// largest element size
    double maximal_size = 6.;
    /// smallest quality (radius ratio, 1 for the regular simplex) accepted
    double minimal_quality = 0.1;
    /// for one attempt at a mesh [s]
    double time_limit = 600.;

    /// Declare the entries in the current subsection.
    void
    declare(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    check() const;

    /// Wider gaps are resolved by the elements of the surfaces [a].
    double
    widest_refined_gap() const;
  };

  /**
   * Mesh the scene: nodes on identified planes match one to one, the vertices
   * on particles lie on the spheres, no cell has two faces on a particle. Cells
   * are ordered along a Hilbert curve and vertices as the cells meet them.
   *
   * A mesh with a cell below the minimal quality, or inverted by the curved
   * faces of a particle, is made again: with all sizes times 0.97, 1.03 and
   * 0.94, then with more optimisation (sizes times 1 and 0.91), then by another
   * algorithm. The same input gives the same mesh, bit by bit, except for that
   * last resort (`attempts` above 6).
   *
   * Each attempt is made in a child process, which may crash or hang: it then
   * counts as failed, after the time limit at the latest.
   *
   * @param before_attempt called in the child process with the number of the
   * attempt, from 1: a test can let it fail there
   *
   * @throws MeshError if no attempt gives an acceptable mesh, InputError if the
   * parameters make no sense.
   */
  template <int dim>
  MeshDescription<dim>
  generate_mesh(
    const Scene<dim>                              &scene,
    const MeshParameters                          &parameters,
    const std::function<void(const unsigned int)> &before_attempt = {});
} // namespace Catena

#endif

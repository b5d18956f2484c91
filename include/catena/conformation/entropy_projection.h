#ifndef catena_conformation_entropy_projection_h
#define catena_conformation_entropy_projection_h

#include <catena/base/types.h>
#include <catena/conformation/tensor_identification.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Catena
{
  /**
   * Projects a conformation c onto the P1 fields of the log-conformation: of
   * all s_h it finds the one that is closest to log(c) in relative entropy,
   *
   * @f[ \int \mathrm{tr}\left( c (\log c - s_h) - c + \exp(s_h) \right)
   *     \rightarrow \min . @f]
   *
   * At its minimum @f$\int N_i \exp(s_h) = \int N_i c@f$ for every vertex i:
   * the elastic stress is conserved, with the quadrature of the flow. (The
   * L2 projection of s conserves s, and so changes the stress by its curvature
   * in s where it varies over an element, which a particle feels as a torque.)
   *
   * The functional is strictly convex. It is minimised by Newton's method with
   * a line search; the Hessian, @f$\int N_i \,D\exp(s_h)\, N_j@f$, is inverted
   * by CG with its lumped blocks as preconditioner, which bound it from above.
   */
  template <int dim>
  class EntropyProjection
  {
  public:
    using Tensors = std::vector<dealii::SymmetricTensor<2, dim>>;

    /**
     * The mesh is kept by reference, with its nodes at @p positions.
     */
    EntropyProjection(const MovingMesh<dim> &mesh, const VectorType &positions);

    /**
     * @param conformation c at the points of CellValues<dim> of all cells
     * @param guess components of a first s_h, not far from log(c)
     * @return the components of s_h
     * @throws SolverError if the iteration does not converge
     */
    std::vector<VectorType>
    project(const Tensors &conformation, const std::vector<VectorType> &guess);

  private:
    static constexpr unsigned int n_components = n_symmetric_components(dim);
    static constexpr unsigned int n_vertices   = n_linear_nodes(dim);

    /// A second derivative of tr exp, in the components of s.
    using Tangent = std::array<std::array<double, n_components>, n_components>;

    struct QuadraturePoint
    {
      double                         JxW;
      std::array<double, n_vertices> shapes;
      Tangent                        tangent;
    };

    class Hessian;
    class LumpedInverse;

    const MovingMesh<dim>          &mesh;
    const TensorIdentification<dim> identification;
    std::vector<QuadraturePoint>    points;
    /// number of the first point of each cell, and of all points
    std::vector<std::size_t> first_points;

    /**
     * The functional at s_h, up to a constant.
     * @param gradient filled if given, and the tangents of the points
     */
    double
    evaluate(const std::vector<VectorType> &s,
             const Tensors                 &conformation,
             BlockVectorType               *gradient);
  };
} // namespace Catena

#endif

#ifndef catena_base_pack_h
#define catena_base_pack_h

#include <deal.II/base/template_constraints.h>

#include <experimental/simd>

namespace Catena
{
  /**
   * Four numbers that are computed with at once: as many as a straight
   * tetrahedron has quadrature points.
   */
  using Pack =
    std::experimental::simd<double,
                            std::experimental::simd_abi::deduce_t<double, 4>>;

  constexpr unsigned int pack_size = Pack::size();

  /// Lane by lane, @p yes where @p condition holds, else @p no.
  template <typename Abi>
  std::experimental::simd<double, Abi>
  select(const std::experimental::simd_mask<double, Abi> &condition,
         const std::experimental::simd<double, Abi>      &yes,
         const std::experimental::simd<double, Abi>      &no)
  {
    auto result              = no;
    where(condition, result) = yes;
    return result;
  }

  inline double
  select(const bool condition, const double yes, const double no)
  {
    return condition ? yes : no;
  }
} // namespace Catena



namespace dealii
{
  /// Tensors may be multiplied by packs.
  template <>
  struct EnableIfScalar<Catena::Pack>
  {
    using type = Catena::Pack;
  };
} // namespace dealii

#include <deal.II/base/symmetric_tensor.h>

namespace Catena
{
  /// One of the tensors of a pack.
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  lane(const dealii::SymmetricTensor<2, dim, Pack> &tensors,
       const unsigned int                           lane)
  {
    dealii::SymmetricTensor<2, dim> tensor;
    for (unsigned int k = 0; k < tensor.n_independent_components; ++k)
      tensor.access_raw_entry(k) = tensors.access_raw_entry(k)[lane];
    return tensor;
  }

  /// Put one into a pack.
  template <int dim>
  void
  set_lane(dealii::SymmetricTensor<2, dim, Pack> &tensors,
           const unsigned int                     lane,
           const dealii::SymmetricTensor<2, dim> &tensor)
  {
    for (unsigned int k = 0; k < tensor.n_independent_components; ++k)
      tensors.access_raw_entry(k)[lane] = tensor.access_raw_entry(k);
  }

  inline void
  set_lane(Pack &numbers, const unsigned int lane, const double number)
  {
    numbers[lane] = number;
  }

  template <int rank, int dim>
  void
  set_lane(dealii::Tensor<rank, dim, Pack> &tensors,
           const unsigned int               lane,
           const dealii::Tensor<rank, dim> &tensor)
  {
    for (unsigned int d = 0; d < dim; ++d)
      set_lane(tensors[d], lane, tensor[d]);
  }
} // namespace Catena

#endif

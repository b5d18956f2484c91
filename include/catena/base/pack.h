#ifndef catena_base_pack_h
#define catena_base_pack_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

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
  inline Pack
  select(const Pack::mask_type &condition, const Pack &yes, const Pack &no)
  {
    Pack result              = no;
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

namespace Catena
{
  /// One of the tensors of a pack.
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  lane(const dealii::SymmetricTensor<2, dim, Pack> &tensors,
       const unsigned int                           k)
  {
    dealii::SymmetricTensor<2, dim> tensor;
    for (unsigned int i = 0; i < tensor.n_independent_components; ++i)
      tensor.access_raw_entry(i) = tensors.access_raw_entry(i)[k];
    return tensor;
  }

  /// Put one into a pack.
  template <int dim>
  void
  set_lane(dealii::SymmetricTensor<2, dim, Pack> &tensors,
           const unsigned int                     k,
           const dealii::SymmetricTensor<2, dim> &tensor)
  {
    for (unsigned int i = 0; i < tensor.n_independent_components; ++i)
      tensors.access_raw_entry(i)[k] = tensor.access_raw_entry(i);
  }

  inline void
  set_lane(Pack &numbers, const unsigned int k, const double number)
  {
    numbers[k] = number;
  }

  template <int rank, int dim>
  void
  set_lane(dealii::Tensor<rank, dim, Pack> &tensors,
           const unsigned int               k,
           const dealii::Tensor<rank, dim> &tensor)
  {
    for (unsigned int d = 0; d < dim; ++d)
      set_lane(tensors[d], k, tensor[d]);
  }
} // namespace Catena

#endif

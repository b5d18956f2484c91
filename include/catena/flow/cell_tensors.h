#ifndef catena_flow_cell_tensors_h
#define catena_flow_cell_tensors_h

#include <catena/base/types.h>
#include <catena/flow/flow_cells.h>

#include <array>
#include <type_traits>

#include <experimental/simd>

namespace Catena
{
  namespace CellKernels
  {
    /**
     * One number of each cell of a batch.
     */
    template <int dim, typename Number>
    using CellPack = std::experimental::simd<
      Number,
      std::experimental::simd_abi::deduce_t<Number, int(cells_at_once)>>;

    /**
     * What is known of a batch, number by number: in single precision the first
     * part of each number alone, in double the sum of both.
     */
    template <int dim, typename Number>
    class CellNumbers
    {
    public:
      using Pack = CellPack<dim, Number>;

      CellNumbers(const float *numbers, const float *remainders)
        : numbers(numbers)
        , remainders(remainders)
      {}

      Pack
      next()
      {
        Pack pack = take(numbers);
        if constexpr (!std::is_same_v<Number, float>)
          pack += take(remainders);
        return pack;
      }

    private:
      const float *numbers, *remainders;

      static Pack
      take(const float *&from)
      {
        const CellPack<dim, float> pack(from,
                                        std::experimental::element_aligned);
        from += cells_at_once;
        return std::experimental::static_simd_cast<Pack>(pack);
      }
    };



    /// A symmetric tensor of each cell.
    template <int dim, typename Number>
    struct SymmetricPacks
    {
      using Pack = CellPack<dim, Number>;
      std::array<std::array<Pack, dim>, dim> components;

      explicit SymmetricPacks(CellNumbers<dim, Number> &numbers)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            components[i][j] = components[j][i] = numbers.next();
      }

      const std::array<Pack, dim> &
      operator[](const unsigned int i) const
      {
        return components[i];
      }
    };



    /// A tensor of each cell.
    template <int dim, typename Number>
    using TensorPacks = std::array<std::array<CellPack<dim, Number>, dim>, dim>;



    /// The symmetric part of a tensor.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    symmetric_part(const TensorPacks<dim, Number> &tensor)
    {
      TensorPacks<dim, Number> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          result[i][j] = result[j][i] =
            Number(0.5) * (tensor[i][j] + tensor[j][i]);
      return result;
    }



    /// From derivatives by the coordinates of the reference cell to those by x.
    /// @param J rows: gradients of the coordinates of the reference cell
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    to_real(const TensorPacks<dim, Number> &gradient,
            const TensorPacks<dim, Number> &J)
    {
      TensorPacks<dim, Number> L = {};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int j = 0; j < dim; ++j)
            L[i][j] += gradient[i][d] * J[d][j];
      return L;
    }



    /// The transpose of to_real().
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    to_reference(const TensorPacks<dim, Number> &stress,
                 const TensorPacks<dim, Number> &J)
    {
      TensorPacks<dim, Number> flux = {};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int j = 0; j < dim; ++j)
            flux[i][d] += stress[i][j] * J[d][j];
      return flux;
    }



    /// A multiple of a tensor.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    multiple(const TensorPacks<dim, Number> &tensor,
             const CellPack<dim, Number>    &factor)
    {
      TensorPacks<dim, Number> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = factor * tensor[i][j];
      return result;
    }



    /// L H + H L^T or, with the roles of u and v exchanged, (L + L^T) H.
    template <int dim, typename Number, bool transposed>
    inline DEAL_II_ALWAYS_INLINE TensorPacks<dim, Number>
    viscous_stress(const TensorPacks<dim, Number>    &L,
                   const SymmetricPacks<dim, Number> &H)
    {
      TensorPacks<dim, Number> product = {}, stress;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            product[i][j] +=
              (transposed ? L[i][k] + L[k][i] : L[i][k]) * H[k][j];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          stress[i][j] =
            transposed ? product[i][j] : product[i][j] + product[j][i];
      return stress;
    }



    /// Add factor (B:L) B.
    template <int dim, typename Number>
    inline DEAL_II_ALWAYS_INLINE void
    add_tangent(TensorPacks<dim, Number>          &stress,
                const TensorPacks<dim, Number>    &L,
                const CellPack<dim, Number>       &factor,
                const SymmetricPacks<dim, Number> &B)
    {
      CellPack<dim, Number> rate(0);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          rate += B[i][j] * L[i][j];
      rate *= factor;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          stress[i][j] += rate * B[i][j];
    }
  } // namespace CellKernels
} // namespace Catena

#endif

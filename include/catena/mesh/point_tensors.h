#ifndef catena_mesh_point_tensors_h
#define catena_mesh_point_tensors_h

#include <catena/base/archive.h>
#include <catena/base/pack.h>
#include <catena/mesh/cell_values.h>
#include <catena/mesh/moving_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <vector>

namespace Catena
{
  /**
   * A symmetric tensor at each quadrature point of CellValues in the cells that
   * this rank owns.
   */
  template <int dim, typename Number = float>
  class PointTensors
  {
  public:
    using Cell       = typename MovingMesh<dim>::Cell;
    using PackValues = typename CellValues<dim>::PackValues;
    using Tensors    = dealii::SymmetricTensor<2, dim, Pack>;

    /// None.
    PointTensors() = default;

    /// Zero.
    explicit PointTensors(const MovingMesh<dim> &mesh);

    bool
    empty() const
    {
      return numbers.empty();
    }

    /// Those of some points of an owned cell; lanes beyond the last point have
    /// its tensor.
    Tensors
    get(const Cell &cell, const PackValues &pack) const;

    void
    set(const Cell &cell, const PackValues &pack, const Tensors &tensors);

    /// Those of an owned cell.
    std::vector<dealii::SymmetricTensor<2, dim>>
    of_cell(const Cell &cell) const;

    /**
     * Save or load them, with the numbers of their cells in the mesh's
     * description, which are the same on any number of ranks. As with
     * FieldArchive, rank 0 saves all. Collective.
     */
    void
    archive(Archive &archive, const MovingMesh<dim> &mesh);

  private:
    /// by cell of the mesh, where its numbers begin, and the end of all: by
    /// pack, component and point
    std::vector<unsigned int> begin;
    std::vector<Number>       numbers;

    static constexpr unsigned int n_components = n_symmetric_components(dim);

    void
    save(Archive &archive, const MovingMesh<dim> &mesh);

    void
    load(Archive &archive, const MovingMesh<dim> &mesh);

    unsigned int
    position(const Cell &cell, const PackValues &pack) const;
  };



  // ---------------------------- inline functions ----------------------------

  template <int dim, typename Number>
  inline unsigned int
  PointTensors<dim, Number>::position(const Cell       &cell,
                                      const PackValues &pack) const
  {
    Assert(cell.owned, dealii::ExcInternalError());
    const unsigned int first = begin[cell.index] + n_components * pack.first;
    Assert(first + n_components * pack.n_points <= begin[cell.index + 1],
           dealii::ExcMessage("The rule is not that of CellValues."));
    return first;
  }



  template <int dim, typename Number>
  inline typename PointTensors<dim, Number>::Tensors
  PointTensors<dim, Number>::get(const Cell &cell, const PackValues &pack) const
  {
    Tensors       tensors;
    const Number *next = numbers.data() + position(cell, pack);
    for (unsigned int k = 0; k < n_components; ++k, next += pack.n_points)
      if (pack.n_points == pack_size)
        tensors.access_raw_entry(k) =
          Pack(next, std::experimental::element_aligned);
      else
        tensors.access_raw_entry(k) = Pack([&](const unsigned int lane) {
          return next[std::min(lane, pack.n_points - 1)];
        });
    return tensors;
  }



  template <int dim, typename Number>
  inline void
  PointTensors<dim, Number>::set(const Cell       &cell,
                                 const PackValues &pack,
                                 const Tensors    &tensors)
  {
    Number *next = numbers.data() + position(cell, pack);
    for (unsigned int k = 0; k < n_components; ++k, next += pack.n_points)
      {
        const Pack &entries = tensors.access_raw_entry(k);
        if (pack.n_points == pack_size)
          entries.copy_to(next, std::experimental::element_aligned);
        else
          for (unsigned int lane = 0; lane < pack.n_points; ++lane)
            next[lane] = entries[lane];
      }
  }
} // namespace Catena

#endif

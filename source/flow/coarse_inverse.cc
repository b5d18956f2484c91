#include <catena/flow/coarse_inverse.h>

#include <deal.II/base/mpi.h>

namespace Catena
{
  using namespace dealii;

  CoarseInverse::CoarseInverse(const SparseRows                  &matrix,
                               const std::vector<FieldMask>      &masks,
                               const Utilities::MPI::Partitioner &nodes)
    : communicator(nodes.get_mpi_communicator())
    , first(nodes.local_range().first)
    , n_owned(nodes.locally_owned_size())
    , values(n_lanes * nodes.size())
  {
    const unsigned int     n = nodes.size();
    FullMatrix<double>     all(n, n);
    std::vector<FieldMask> all_masks;
    for (const auto &some : Utilities::MPI::all_gather(communicator, masks))
      all_masks.insert(all_masks.end(), some.begin(), some.end());
    unsigned int row = 0;
    for (const auto &some : Utilities::MPI::all_gather(communicator, matrix))
      for (unsigned int i = 0; i < some.size(); ++i, ++row)
        for (unsigned int k = some.starts[i]; k < some.starts[i + 1]; ++k)
          all(row, some.columns[k]) += some.values[k];

    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        std::vector<bool> unknowns;
        for (const FieldMask mask : all_masks)
          unknowns.push_back((mask >> lane) & 1U);
        Part *part = nullptr;
        for (Part &other : parts)
          if (other.unknowns == unknowns)
            part = &other;
        if (part == nullptr)
          {
            parts.emplace_back();
            part           = &parts.back();
            part->unknowns = unknowns;
            part->inverse  = invert(all, unknowns);
          }
        part->selection[lane] = 1.f;
      }
  }



  /// Inverse of the rows and columns of unknowns, zero elsewhere.
  FullMatrix<float>
  CoarseInverse::invert(FullMatrix<double>       matrix,
                        const std::vector<bool> &unknowns)
  {
    const unsigned int n = matrix.m();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        if (!unknowns[i] || !unknowns[j])
          matrix(i, j) = i == j ? 1. : 0.;
    matrix.gauss_jordan();
    FullMatrix<float> inverse(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        if (unknowns[i] && unknowns[j])
          inverse(i, j) = matrix(i, j);
    return inverse;
  }



  void
  CoarseInverse::vmult(NodeVector &dst, const NodeVector &src) const
  {
    values.fill(0.f);
    std::copy(src.begin(),
              src.begin() + n_lanes * n_owned,
              values.begin() + n_lanes * first);
    const ArrayView<float> view(values.data(), values.size());
    Utilities::MPI::sum(ArrayView<const float>(view), communicator, view);
    const Lanes *const all = reinterpret_cast<const Lanes *>(values.data());
    const unsigned int n   = values.size() / n_lanes;
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        lanes(dst)[i] = Lanes{};
        for (const Part &part : parts)
          {
            const float *row = &part.inverse(first + i, 0);
            Lanes        sum = {};
            for (unsigned int j = 0; j < n; ++j)
              sum += row[j] * all[j];
            lanes(dst)[i] += part.selection * sum;
          }
      }
  }
} // namespace Catena

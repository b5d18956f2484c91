#include <catena/flow/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// theta, above which a coupling is strong
    constexpr float strong_coupling = 0.04f;

    /// The highest mode can be one of few elements, which is found slowly.
    constexpr unsigned int n_power_iterations = 20;



    /**
     * Of D^-1 A, by power iteration from numbers that follow from those of the
     * nodes.
     */
    double
    largest_eigenvalue(const NodeRows               &matrix,
                       const std::vector<float>     &diagonal,
                       const std::vector<FieldMask> &masks)
    {
      const auto        &nodes = matrix.column_nodes();
      const unsigned int n     = matrix.n_rows();
      NodeVector         vector, product;
      reinit(vector, nodes);
      reinit(product, nodes);
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int node = nodes.local_to_global(i);
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            if ((masks[i] >> lane) & 1U)
              lanes(vector)[i][lane] =
                (7919 * node + 104729 * lane) % 1009 / 1009.f - 0.5f;
        }
      double eigenvalue = 0.;
      for (unsigned int iteration = 0; iteration < n_power_iterations;
           ++iteration)
        {
          vector.update_ghost_values();
          double square = 0.;
          for (unsigned int i = 0; i < n; ++i)
            {
              Lanes value = matrix.row_times(i, lanes(vector)) / diagonal[i];
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                {
                  if (!((masks[i] >> lane) & 1U))
                    value[lane] = 0.f;
                  square += value[lane] * value[lane];
                }
              lanes(product)[i] = value;
            }
          eigenvalue = std::sqrt(
            Utilities::MPI::sum(square, nodes.get_mpi_communicator()));
          const float scaling = 1. / eigenvalue;
          for (unsigned int i = 0; i < n; ++i)
            lanes(vector)[i] = scaling * lanes(product)[i];
        }
      return eigenvalue;
    }
  } // namespace



  SmoothedAggregation::SmoothedAggregation(
    const NodeRows               &matrix,
    const std::vector<FieldMask> &node_masks)
  {
    const auto        &nodes = matrix.column_nodes();
    const MPI_Comm     comm  = nodes.get_mpi_communicator();
    std::vector<float> diagonal;
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      diagonal.push_back(matrix.diagonal(i));
    std::vector<unsigned int> aggregates =
      aggregate(matrix, diagonal, node_masks);

    // numbers for all ranks
    const unsigned int first =
      first_of_ranks(masks.size(),
                     comm)[Utilities::MPI::this_mpi_process(comm)];
    for (unsigned int &a : aggregates)
      if (a != none)
        a += first;
    aggregates = with_ghosts(aggregates, nodes);

    FieldMask all = 0;
    for (const FieldMask mask : node_masks)
      all |= mask;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_UNSIGNED_CHAR, MPI_BOR, comm);

    const float omega =
      4. / (3. * largest_eigenvalue(matrix, diagonal, node_masks));
    std::vector<std::pair<unsigned int, float>> row;
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      {
        row.clear();
        if (aggregates[i] != none)
          row.push_back({aggregates[i], 1.f});
        if (node_masks[i] == all)
          {
            const float weight = omega / diagonal[i];
            const auto  range  = matrix.row(i);
            for (unsigned int k = range.first; k < range.second; ++k)
              if (aggregates[matrix.column(k)] != none)
                row.emplace_back(aggregates[matrix.column(k)],
                                 -weight * matrix.value(k));
            std::sort(row.begin(), row.end(), [](const auto &a, const auto &b) {
              return a.first < b.first;
            });
          }
        for (unsigned int k = 0; k < row.size(); ++k)
          if (k > 0 && row[k].first == row[k - 1].first)
            prolongation.values.back() += row[k].second;
          else
            prolongation.add(row[k].first, row[k].second);
        prolongation.end_row();
      }
  }



  std::vector<unsigned int>
  SmoothedAggregation::aggregate(const NodeRows               &matrix,
                                 const std::vector<float>     &diagonal,
                                 const std::vector<FieldMask> &node_masks)
  {
    const unsigned int n = matrix.n_rows();

    const auto is_strong = [&](const unsigned int i, const unsigned int k) {
      const unsigned int j = matrix.column(k);
      const float        a = matrix.value(k);
      return j != i && j < n && node_masks[i] == node_masks[j] && a < 0.f &&
             a * a >
               strong_coupling * strong_coupling * diagonal[i] * diagonal[j];
    };

    // neighbourhoods that do not touch each other
    std::vector<unsigned int> aggregates(n, none);
    for (unsigned int i = 0; i < n; ++i)
      {
        if (aggregates[i] != none || node_masks[i] == 0)
          continue;
        const auto range = matrix.row(i);
        bool       free  = true;
        for (unsigned int k = range.first; k < range.second && free; ++k)
          free = !is_strong(i, k) || aggregates[matrix.column(k)] == none;
        if (!free)
          continue;
        aggregates[i] = masks.size();
        for (unsigned int k = range.first; k < range.second; ++k)
          if (is_strong(i, k))
            aggregates[matrix.column(k)] = masks.size();
        masks.push_back(node_masks[i]);
      }

    // other nodes join the one to which they are coupled most
    std::vector<unsigned int> joined(aggregates);
    for (unsigned int i = 0; i < n; ++i)
      if (aggregates[i] == none)
        {
          float      strongest = 0.f;
          const auto range     = matrix.row(i);
          for (unsigned int k = range.first; k < range.second; ++k)
            if (is_strong(i, k) && aggregates[matrix.column(k)] != none &&
                matrix.value(k) < strongest)
              {
                strongest = matrix.value(k);
                joined[i] = aggregates[matrix.column(k)];
              }
        }
    return joined;
  }
} // namespace Catena

// The sweeps of a level of the multigrid against the equations that define
// them, with all entries of the operator, for fields that do not share all of
// them and one without an unknown at some nodes.

#include <catena/flow/multigrid_level.h>

#include "../tests.h"

using namespace dealii;
using namespace Catena;

namespace
{
  constexpr unsigned int nodes_of_rank = 12;
  constexpr unsigned int other_field = 2, field_with_walls = 3;

  /// Nodes on a ring, with bonds to the next and the one after the next.
  double
  shared_entry(const unsigned int i, const unsigned int j, const unsigned int n)
  {
    const unsigned int distance = std::min((i + n - j) % n, (j + n - i) % n);
    if (distance == 0)
      return 3. + i % 5 / 4.;
    return distance == 1 ? -1. - (i + j) % 3 / 8. : distance == 2 ? -0.25 : 0.;
  }

  /// One of the fields comes back with the opposite sign, and more of it.
  bool
  crosses_plane(const unsigned int i, const unsigned int j)
  {
    return (i < 5) != (j < 5);
  }

  double
  entry(const unsigned int field,
        const unsigned int i,
        const unsigned int j,
        const unsigned int n)
  {
    const double a = shared_entry(i, j, n);
    return field == other_field && crosses_plane(i, j) ? -1.5 * a : a;
  }

  bool
  has_unknown(const unsigned int field, const unsigned int node)
  {
    return field == field_with_walls ? node % 7 != 3 :
           field == other_field      ? node % 5 != 4 :
                                       true;
  }

  SparseRows
  rows(const unsigned int field, const IndexSet &owned)
  {
    SparseRows result;
    for (const auto i : owned)
      {
        for (unsigned int j = 0; j < owned.size(); ++j)
          if (shared_entry(i, j, owned.size()) != 0.)
            result.add(j, entry(field, i, j, owned.size()));
        result.end_row();
      }
    return result;
  }

  /// All values of a field on every rank, zero where it has no unknown.
  std::vector<double>
  gather(const NodeVector &vector, const unsigned int field)
  {
    const unsigned int  n     = vector.size() / n_lanes;
    const auto          range = vector.locally_owned_elements();
    std::vector<double> values(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      if (range.is_element(n_lanes * i) && has_unknown(field, i))
        values[i] = vector(n_lanes * i + field);
    Utilities::MPI::sum(values, vector.get_mpi_communicator(), values);
    return values;
  }

  struct Errors
  {
    double residual = 0., before = 0., after = 0.;
  };

  double
  right_hand_side(const unsigned int field, const unsigned int node)
  {
    return (5 * node + 3 * field) % 16 / 8. - 1.;
  }

  double
  correction(const unsigned int field, const unsigned int node)
  {
    return has_unknown(field, node) ? (3 * node + field) % 8 / 16. : 0.;
  }

  void
  compare(Errors                    &errors,
          const unsigned int         field,
          const std::vector<double> &first,
          const std::vector<double> &residual,
          const std::vector<double> &last)
  {
    const unsigned int n       = first.size();
    const auto         rank_of = [](const unsigned int node) {
      return node / nodes_of_rank;
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!has_unknown(field, i))
          continue;
        double diagonal = entry(field, i, i, n), left = residual[i],
               before = -right_hand_side(field, i), after = before;
        for (unsigned int j = 0; j < n; ++j)
          if (has_unknown(field, j))
            {
              const double a         = entry(field, i, j, n);
              const double corrected = first[j] + correction(field, j);
              left += a * first[j];
              if (rank_of(i) != rank_of(j))
                {
                  const double shared = shared_entry(i, j, n);
                  after += a * corrected;
                  diagonal += std::abs(shared) + std::abs(a - shared);
                }
              else if (j < i)
                {
                  before += a * first[j];
                  after += a * corrected;
                }
              else if (j > i)
                after += a * last[j];
            }
          else if (rank_of(i) != rank_of(j))
            diagonal += std::abs(shared_entry(i, j, n));
        before += diagonal * first[i];
        after += diagonal * last[i];
        // the part that other ranks add to D acts on the change alone
        after -= (diagonal - entry(field, i, i, n)) *
                 (first[i] + correction(field, i));
        errors.residual =
          std::max(errors.residual, std::abs(left - right_hand_side(field, i)));
        errors.before = std::max(errors.before, std::abs(before));
        errors.after  = std::max(errors.after, std::abs(after));
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const MPI_Comm     comm    = MPI_COMM_WORLD;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm),
                       rank    = Utilities::MPI::this_mpi_process(comm),
                       n       = n_ranks * nodes_of_rank;
    IndexSet owned(n);
    owned.add_range(nodes_of_rank * rank, nodes_of_rank * (rank + 1));

    SparseRows shared_rows = rows(0, owned),
               other_rows  = rows(other_field, owned);
    const auto nodes       = make_nodes(nodes_of_rank, {&shared_rows}, comm);
    shared_rows.make_local(*nodes);
    other_rows.make_local(*nodes);
    std::vector<FieldMask> masks(nodes_of_rank);
    for (unsigned int i = 0; i < nodes_of_rank; ++i)
      for (unsigned int field = 0; field < n_lanes; ++field)
        if (has_unknown(field, nodes->local_to_global(i)))
          masks[i] |= 1U << field;
    const FieldMask      other = 1U << other_field, all = (1U << n_lanes) - 1;
    const MultigridLevel level({{FieldMask(all & ~other), {shared_rows, nodes}},
                                {other, {other_rows, nodes}}},
                               masks);

    const auto set = [&](NodeVector &vector, const auto &value) {
      for (unsigned int i = 0; i < nodes_of_rank; ++i)
        for (unsigned int field = 0; field < n_lanes; ++field)
          vector.local_element(n_lanes * i + field) =
            value(field, nodes->local_to_global(i));
    };
    // nothing is left of an earlier use
    set(level.residual, correction);
    level.smooth_from_zero();
    level.smooth_corrected();

    set(level.residual, right_hand_side);
    level.smooth_from_zero();
    const NodeVector first = level.solution, residual = level.residual;
    NodeVector       change(first);
    set(change, correction);
    level.solution.add(1.f, change);
    level.smooth_corrected();

    Errors errors;
    for (unsigned int field = 0; field < n_lanes; ++field)
      compare(errors,
              field,
              gather(first, field),
              gather(residual, field),
              gather(level.solution, field));
    claims.at_most("the residual is right", errors.residual, 1e-6);
    claims.at_most("the sweep from zero is right", errors.before, 1e-6);
    claims.at_most("the sweep after a correction is right", errors.after, 1e-6);
  });
}

// The same scene gives the same mesh, bit by bit, whatever was meshed before.

#include "../tests.h"

#include "scenes.h"

using namespace Catena;

template <int dim>
bool
equal(const MeshDescription<dim> &a, const MeshDescription<dim> &b)
{
  bool same = a.vertices == b.vertices && a.cells.size() == b.cells.size() &&
              boundary_faces(a).size() == boundary_faces(b).size();
  for (unsigned int i = 0; same && i < a.cells.size(); ++i)
    same = a.cells[i].vertices == b.cells[i].vertices;
  for (unsigned int i = 0; same && i < boundary_faces(a).size(); ++i)
    same = boundary_faces(a)[i] == boundary_faces(b)[i];
  return same;
}

template <int dim>
void
repeat(Tests::Claims &claims)
{
  const auto parameters = Tests::resolution(32, 2);
  const auto first = generate_mesh(Tests::three_particles<dim>(), parameters);
  const auto other =
    generate_mesh(Tests::three_particles<dim>(2.5, -20.), parameters);
  const auto again = generate_mesh(Tests::three_particles<dim>(), parameters);

  const std::string in = " in " + std::to_string(dim) + "D";
  claims.holds("the same scene gives the same mesh" + in, equal(first, again));
  claims.holds("another scene gives another mesh" + in, !equal(first, other));
}

int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    repeat<2>(claims);
    repeat<3>(claims);
  });
}

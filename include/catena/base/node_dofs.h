#ifndef catena_base_node_dofs_h
#define catena_base_node_dofs_h

#include <deal.II/base/index_set.h>

namespace Catena
{
  /// The degrees of freedom of @p nodes with @p n_components each, one node
  /// after the other.
  inline dealii::IndexSet
  node_dofs(const dealii::IndexSet &nodes, const unsigned int n_components)
  {
    dealii::IndexSet dofs(n_components * nodes.size());
    for (auto it = nodes.begin_intervals(); it != nodes.end_intervals(); ++it)
      dofs.add_range(n_components * *it->begin(),
                     n_components * (it->last() + 1));
    return dofs;
  }
} // namespace Catena

#endif

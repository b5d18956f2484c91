#ifndef catena_flow_galerkin_product_h
#define catena_flow_galerkin_product_h

#include <catena/flow/node_matrix.h>

namespace Catena
{
  /**
   * P^T A P, the operator on a coarser level.
   *
   * The rows of P of nodes next to another rank's are exchanged, and what is
   * found for rows of another rank is sent to it.
   *
   * @param prolongation the rows of P of this rank's nodes
   * @param n_coarse how many nodes of the coarser level are this rank's
   * @return the rows of this rank
   */
  SparseRows
  galerkin_product(const NodeRows    &matrix,
                   const SparseRows  &prolongation,
                   const unsigned int n_coarse);
} // namespace Catena

#endif

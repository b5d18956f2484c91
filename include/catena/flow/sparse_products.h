#ifndef catena_flow_sparse_products_h
#define catena_flow_sparse_products_h

#include <catena/base/types.h>

#include <vector>

namespace Catena
{
  /**
   * Products with vectors that have few entries which are not zero, those of
   * this rank.
   */
  class SparseProducts
  {
  public:
    void
    clear()
    {
      vectors.clear();
    }

    /// One more vector.
    void
    add(const FastVectorType &vector)
    {
      vectors.emplace_back();
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        if (vector.local_element(i) != 0.)
          vectors.back().push_back({i, vector.local_element(i)});
    }

    /// products[k] += vector k . src, the part of this rank
    void
    add_to(std::vector<double> &products, const FastVectorType &src) const
    {
      for (unsigned int k = 0; k < vectors.size(); ++k)
        for (const Entry &entry : vectors[k])
          products[k] += entry.value * src.local_element(entry.index);
    }

  private:
    struct Entry
    {
      unsigned int index;
      float        value;
    };
    std::vector<std::vector<Entry>> vectors;
  };
} // namespace Catena

#endif

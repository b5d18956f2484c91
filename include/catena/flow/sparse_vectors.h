#ifndef catena_flow_sparse_vectors_h
#define catena_flow_sparse_vectors_h

#include <catena/base/types.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace Catena
{
  /**
   * Vectors that have few entries which are not zero, those of this rank.
   */
  class SparseVectors
  {
  public:
    unsigned int
    size() const
    {
      return vectors.size();
    }

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

    /// By vector, its product with @p src. Collective, if there are vectors.
    std::vector<double>
    products(const FastVectorType &src) const
    {
      std::vector<double> result(vectors.size(), 0.);
      if (result.empty())
        return result;
      for (unsigned int k = 0; k < vectors.size(); ++k)
        for (const Entry &entry : vectors[k])
          result[k] += entry.value * src.local_element(entry.index);
      dealii::Utilities::MPI::sum(result, src.get_mpi_communicator(), result);
      return result;
    }

    /// dst += factor vector k
    void
    add_to(FastVectorType &dst, const unsigned int k, const double factor) const
    {
      for (const Entry &entry : vectors[k])
        dst.local_element(entry.index) += factor * entry.value;
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

#include <catena/base/exceptions.h>
#include <catena/mesh/node_identification.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr double tolerance = 1e-6;

    /**
     * Points hashed on a grid of twice the tolerance, to be found again from
     * nearly equal coordinates.
     */
    template <int dim>
    class PointMap
    {
    public:
      void
      insert(const Point<dim> &p, const unsigned int index)
      {
        points[key(p)] = {p, index};
      }

      /// Index of the point at @p p or numbers::invalid_unsigned_int.
      unsigned int
      find(const Point<dim> &p) const
      {
        Key k = key(p);
        return find(p, k, 0);
      }

    private:
      using Key = std::array<long, dim>;
      std::map<Key, std::pair<Point<dim>, unsigned int>> points;

      static Key
      key(const Point<dim> &p)
      {
        Key k;
        for (unsigned int d = 0; d < dim; ++d)
          k[d] = std::lround(p[d] / (2. * tolerance));
        return k;
      }

      unsigned int
      find(const Point<dim> &p, Key &k, const unsigned int d) const
      {
        if (d == dim)
          {
            const auto it = points.find(k);
            return it != points.end() &&
                       it->second.first.distance(p) < tolerance ?
                     it->second.second :
                     numbers::invalid_unsigned_int;
          }
        const long centre = k[d];
        for (const long step : {0, -1, 1})
          {
            k[d]                     = centre + step;
            const unsigned int index = find(p, k, d + 1);
            if (index != numbers::invalid_unsigned_int)
              return index;
          }
        k[d] = centre;
        return numbers::invalid_unsigned_int;
      }
    };
  } // namespace



  template <int dim>
  NodeIdentification::NodeIdentification(
    const Scene<dim>                 &scene,
    const std::vector<Point<dim>>    &points,
    const std::vector<std::uint32_t> &boundaries)
    : masters(points.size())
    , turns(points.size(), 0)
    , axis(points.size(), 0)
  {
    std::iota(masters.begin(), masters.end(), 0u);

    for (const Identification<dim> &identification : scene.identifications())
      {
        PointMap<dim> targets;
        for (unsigned int i = 0; i < points.size(); ++i)
          if (boundaries[i] & (1u << identification.to))
            targets.insert(points[i], i);

        for (unsigned int i = 0; i < points.size(); ++i)
          if (boundaries[i] & (1u << identification.from))
            {
              const Point<dim> image   = identification.image(points[i]);
              unsigned int     partner = targets.find(image);
              for (int k = -2; k <= 2 && identification.period > 0. &&
                               partner == numbers::invalid_unsigned_int;
                   ++k)
                {
                  Point<dim> moved = image;
                  moved[0] += k * identification.period;
                  partner = targets.find(moved);
                }
              if (partner == numbers::invalid_unsigned_int)
                {
                  std::ostringstream text;
                  text << "The mesh node at " << points[i]
                       << " on an identified plane has no counterpart.";
                  throw MeshError(text.str());
                }
              unite(i, partner, identification.rotation);
            }
      }

    for (unsigned int i = 0; i < points.size(); ++i)
      {
        char turn  = 0;
        masters[i] = root(i, turn);
        turns[i]   = turn;
      }
  }



  unsigned int
  NodeIdentification::root(unsigned int node, char &turn) const
  {
    while (masters[node] != node)
      {
        turn ^= turns[node];
        node = masters[node];
      }
    return node;
  }



  void
  NodeIdentification::unite(const unsigned int a,
                            const unsigned int b,
                            const bool         rotation)
  {
    char               turn_a = 0, turn_b = 0;
    const unsigned int root_a = root(a, turn_a), root_b = root(b, turn_b);
    const char         turn = turn_a ^ turn_b ^ (rotation ? 1 : 0);
    if (root_a == root_b)
      axis[root_a] |= turn;
    else
      {
        masters[root_b] = root_a;
        turns[root_b]   = turn;
        axis[root_a] |= axis[root_b];
      }
  }



  template NodeIdentification::NodeIdentification(
    const Scene<2> &,
    const std::vector<Point<2>> &,
    const std::vector<std::uint32_t> &);
  template NodeIdentification::NodeIdentification(
    const Scene<3> &,
    const std::vector<Point<3>> &,
    const std::vector<std::uint32_t> &);
} // namespace Catena

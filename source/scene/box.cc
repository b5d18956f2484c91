#include <catena/base/exceptions.h>
#include <catena/scene/box.h>

#include <map>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    constexpr double largest_size = 1e4;
  } // namespace



  void
  BoxParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Length",
                      length,
                      "L, period of the box along the flow [a].",
                      Patterns::Double());
    prm.add_parameter("Height",
                      height,
                      "H, distance of the walls [a].",
                      Patterns::Double());
    prm.add_parameter("Width",
                      width,
                      "W, width of the box along the vorticity [a].",
                      Patterns::Double());
  }



  void
  BoxParameters::check() const
  {
    for (const auto &size : {std::make_pair("Scene/Length", length),
                             std::make_pair("Scene/Height", height),
                             std::make_pair("Scene/Width", width)})
      require(size.second > 0. && size.second <= largest_size,
              size.first,
              size.second,
              "give a positive size of at most 10000 a");
  }



  template <int dim>
  Scene<dim>
  BoxParameters::scene(const Symmetry symmetry) const
  {
    Scene<dim> result;
    result.length   = length;
    result.height   = height;
    result.width    = width;
    result.symmetry = symmetry;
    return result;
  }



  void
  declare_domain(ParameterHandler  &prm,
                 const std::string &names,
                 const std::string &documentation,
                 Symmetry          &symmetry)
  {
    const std::map<Symmetry, std::string> all = {{Symmetry::none, "full"},
                                                 {Symmetry::half, "half"},
                                                 {Symmetry::quarter,
                                                  "quarter"}};
    prm.declare_entry("Domain",
                      all.at(symmetry),
                      Patterns::Selection(names),
                      documentation);
    prm.add_action("Domain", [&symmetry, all](const std::string &chosen) {
      for (const auto &entry : all)
        if (entry.second == chosen)
          symmetry = entry.first;
    });
  }



  template Scene<2>
  BoxParameters::scene<2>(const Symmetry) const;
  template Scene<3>
  BoxParameters::scene<3>(const Symmetry) const;
} // namespace Catena

#ifndef catena_scene_box_h
#define catena_scene_box_h

#include <catena/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

namespace Catena
{
  /**
   * The size of the box, in particle radii a.
   */
  struct BoxParameters
  {
    double length = 80.; ///< L, period along the flow
    double height = 40.; ///< H, distance of the walls
    double width  = 20.; ///< W, along the vorticity

    /// In the current subsection, which should be `Scene`.
    void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for sizes that are not positive
    void
    check() const;

    /// A box with no particles in it.
    template <int dim>
    Scene<dim>
    scene(const Symmetry symmetry) const;
  };



  /**
   * Declare the entry "Domain" in the current subsection: how much of the box
   * is meshed.
   *
   * @param names those of full|half|quarter that can be chosen, separated by |
   */
  void
  declare_domain(dealii::ParameterHandler &prm,
                 const std::string        &names,
                 const std::string        &documentation,
                 Symmetry                 &symmetry);
} // namespace Catena

#endif

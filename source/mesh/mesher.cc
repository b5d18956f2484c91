#include <catena/base/child_process.h>
#include <catena/base/exceptions.h>
#include <catena/mesh/boundary_snapper.h>
#include <catena/mesh/gmsh_model.h>
#include <catena/mesh/mesher.h>
#include <catena/mesh/size_field.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

namespace Catena
{
  using dealii::Point;

  namespace
  {
    /// One try at a mesh: sizes are multiplied by scale.
    struct Attempt
    {
      double         scale;
      MeshingOptions options;
    };

    /// The tries in their order, those that cannot be repeated exactly last.
    const std::vector<Attempt> attempts = {
      {1.00, {MeshingOptions::delaunay, 0}},
      {0.97, {MeshingOptions::delaunay, 0}},
      {1.03, {MeshingOptions::delaunay, 0}},
      {0.94, {MeshingOptions::delaunay, 0}},
      {1.00, {MeshingOptions::delaunay, 3}},
      {0.91, {MeshingOptions::delaunay, 3}},
      {1.00, {MeshingOptions::hxt, 0}},
      {0.97, {MeshingOptions::hxt, 3}}};



    /// Boundary, orientation and order of a mesh as gmsh gives it.
    template <int dim>
    void
    finish(const Scene<dim> &scene, MeshDescription<dim> &mesh)
    {
      remove_flat_cells(mesh);
      orient_cells(mesh);
      {
        BoundarySnapper<dim> snapper(scene, mesh);
        // the second pass carries a node through a chain of images
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (const auto &identification : scene.identifications())
            snapper.match(identification);
        snapper.snap_to_planes();
      }
      order_along_curve(mesh);
    }
  } // namespace



  template <int dim>
  MeshDescription<dim>
  generate_mesh(const Scene<dim>                              &scene,
                const MeshParameters                          &parameters,
                const std::function<void(const unsigned int)> &before_attempt)
  {
    parameters.check();

    double       best  = -std::numeric_limits<double>::infinity();
    unsigned int count = 0;
    std::string  failure;
    for (const auto &attempt : attempts)
      {
        ++count;
        const auto make = [&]() {
          if (before_attempt)
            before_attempt(count);
          GmshModel<dim>       model(scene);
          MeshDescription<dim> mesh =
            model.generate(SizeField<dim>(scene, parameters, attempt.scale),
                           attempt.options);
          finish(scene, mesh);
          Archive archive;
          archive(mesh);
          return archive.bytes();
        };
        try
          {
            Archive archive(run_in_child(make, parameters.time_limit));
            MeshDescription<dim> mesh;
            archive(mesh);
            mesh.quality  = smallest_quality(scene, mesh);
            mesh.attempts = count;
            if (mesh.quality >= parameters.minimal_quality)
              return mesh;
            best = std::max(best, mesh.quality);
          }
        catch (const Error &error)
          {
            failure = std::string("; last failure: ") + error.what();
          }
      }

    std::ostringstream text;
    text << "No acceptable mesh in " << count << " attempts: best quality "
         << best << ", wanted " << parameters.minimal_quality
         << "; raise 'Elements on equator' or lower 'Minimal quality'"
         << failure;
    throw MeshError(text.str());
  }



  void
  MeshParameters::declare(dealii::ParameterHandler &parameters)
  {
    using namespace dealii::Patterns;
    parameters.add_parameter(
      "Elements on equator",
      elements_on_equator,
      "n_part, elements along the equator of a particle: their size is "
      "2 pi a / n_part. At least 8.",
      Integer(0));
    parameters.add_parameter(
      "Elements across gap",
      elements_across_gap,
      "n_min, smallest number of elements across the gap between two "
      "particles or a particle and a wall. At least 1.",
      Integer(0));
    parameters.add_parameter(
      "Gap stretch",
      gap_stretch,
      "How many times longer elements may be along a gap between particles "
      "than across it: the mesh is made with gaps as many times wider, and "
      "pressed. From 1 to 8.",
      Double());
    parameters.add_parameter(
      "Size growth",
      growth,
      "Growth of the element size per unit of distance from a particle "
      "(a per a) at 64 elements on the equator. A finer mesh grows slower, as "
      "n_part^(-2/3), to be finer everywhere. Between 0.01 and 1.",
      Double());
    parameters.add_parameter("Maximal size",
                             maximal_size,
                             "Largest element size, in particle radii a.",
                             Double());
    parameters.add_parameter(
      "Minimal quality",
      minimal_quality,
      "Smallest quality (inscribed over circumscribed radius, 1 for the "
      "regular simplex) of a cell that is accepted; a mesh with a worse cell "
      "is made again. Between 0 and 0.3.",
      Double());
    parameters.add_parameter("Time limit",
                             time_limit,
                             "Wall time after which an attempt at a mesh has "
                             "failed, and another one is made [s].",
                             Double());
  }



  void
  MeshParameters::check() const
  {
    require(elements_on_equator >= 8 && elements_on_equator <= 2000,
            "Elements on equator",
            elements_on_equator,
            "give a number from 8 to 2000");
    require(elements_across_gap >= 1 && elements_across_gap <= 20,
            "Elements across gap",
            elements_across_gap,
            "give a number from 1 to 20");
    require(gap_stretch >= 1. && gap_stretch <= 8.,
            "Gap stretch",
            gap_stretch,
            "give a number from 1 to 8");
    require(growth >= 0.01 && growth <= 1.,
            "Size growth",
            growth,
            "give a number from 0.01 to 1");
    require(maximal_size >= 1e-3 && maximal_size <= 1e4,
            "Maximal size",
            maximal_size,
            "give a positive length in particle radii, from 1e-3 to 1e4");
    require(minimal_quality >= 0. && minimal_quality <= 0.3,
            "Minimal quality",
            minimal_quality,
            "give a number from 0 to 0.3");
    require(time_limit >= 1. && time_limit <= 1e6,
            "Time limit",
            time_limit,
            "give a time from 1 to 1e6 seconds");
  }



  double
  MeshParameters::widest_refined_gap() const
  {
    return 2. * dealii::numbers::PI * elements_across_gap / elements_on_equator;
  }



  template MeshDescription<2>
  generate_mesh(const Scene<2> &,
                const MeshParameters &,
                const std::function<void(const unsigned int)> &);
  template MeshDescription<3>
  generate_mesh(const Scene<3> &,
                const MeshParameters &,
                const std::function<void(const unsigned int)> &);
} // namespace Catena

#include <catena/flow/gap_pressures.h>
#include <catena/mesh/cell_fields.h>
#include <catena/particles/contacts.h>

#include <algorithm>
#include <cmath>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    /// Wider gaps [a] are no films; in narrower ones pressures have more forms.
    constexpr double widest = 0.2, very_narrow = 0.03;

    /// A film ends where q is smaller.
    constexpr double smallest_share = 0.1;

    /// of the norm of a pressure, what the others must leave of it
    constexpr double smallest_remainder = 1e-2;

    /// Each one costs the preconditioner a vector and its product.
    constexpr unsigned int most_pressures = 32;



    /// A power of q, times the coordinate in a tangential direction or 1.
    template <int dim>
    struct Form
    {
      double         power;
      Tensor<1, dim> direction;
    };



    /// The film between two spheres.
    template <int dim>
    class Film
    {
    public:
      Film(const Surface<dim> &one, const Surface<dim> &other)
        : one(one)
        , other(other)
      {
        const double distance = one.centre.distance(other.centre);
        normal                = (other.centre - one.centre) / distance;
        width                 = distance - one.radius - other.radius;
        middle                = one.centre + (one.radius + width / 2.) * normal;
      }

      bool
      operator<(const Film &film) const
      {
        return width < film.width;
      }

      std::vector<Form<dim>>
      forms() const
      {
        std::vector<double> powers = {2., 4.}, tangential_powers = {3.};
        if (width < very_narrow)
          {
            powers.push_back(1.);
            tangential_powers.push_back(2.);
          }
        std::vector<Form<dim>> result;
        for (const double power : powers)
          result.push_back({power, {}});
        for (const double power : tangential_powers)
          for (const Tensor<1, dim> &direction : tangents())
            result.push_back({power, direction});
        return result;
      }

      /// q at @p p, zero outside
      double
      share(const Point<dim> &p) const
      {
        const double q = width / (p.distance(one.centre) - one.radius +
                                  p.distance(other.centre) - other.radius);
        return q > smallest_share ? q : 0.;
      }

      double
      value(const Form<dim> &form, const double q, const Point<dim> &p) const
      {
        const double place =
          form.direction.norm() > 0. ? form.direction * (p - middle) : 1.;
        return place * std::pow(q, form.power);
      }

    private:
      Surface<dim>   one, other;
      Tensor<1, dim> normal;
      double         width;
      Point<dim>     middle;

      /// The first one in the plane of the shear if the normal is.
      std::vector<Tensor<1, dim>>
      tangents() const
      {
        Tensor<1, dim> first;
        if constexpr (dim == 2)
          {
            first[0] = -normal[1];
            first[1] = normal[0];
            return {first};
          }
        else
          {
            Tensor<1, dim> z;
            z[dim - 1] = 1.;
            first      = cross_product_3d(z, normal);
            if (first.norm() < 1e-6)
              first[0] = 1.;
            first /= first.norm();
            return {first, cross_product_3d(normal, first)};
          }
      }
    };



    /// The narrowest first.
    template <int dim>
    std::vector<Film<dim>>
    films(const Scene<dim> &scene, const Configuration<dim> &configuration)
    {
      const auto surface = [&](const unsigned int i, const Image<dim> &image) {
        return Surface<dim>{i,
                            image,
                            image(configuration.centres[i]),
                            scene.particles[i].radius};
      };
      std::vector<Film<dim>> result;
      const Contacts<dim>    contacts(scene, widest / 2.);
      for (const Contact<dim> &contact : contacts.candidates(configuration))
        if (contact.partner == Contact<dim>::Partner::particle)
          result.emplace_back(surface(contact.i, {}),
                              surface(contact.j, contact.image));
      std::stable_sort(result.begin(), result.end());
      return result;
    }



    /// What the symmetries of a scene make of @p p.
    template <int dim>
    std::vector<Point<dim>>
    copies(const std::vector<Image<dim>> &images,
           const bool                     mirrored,
           const Point<dim>              &p)
    {
      std::vector<Point<dim>> result;
      for (const Image<dim> &image : images)
        {
          result.push_back(image(p));
          if (mirrored)
            {
              result.push_back(result.back());
              result.back()[dim - 1] *= -1.;
            }
        }
      return result;
    }



    /// A vertex in a film, as one of its copies is: its q and its place.
    template <int dim>
    struct VertexInFilm
    {
      unsigned int vertex;
      double       share;
      Point<dim>   place;
    };



    /// Of the vertices of this rank, those of one vertex in a row.
    template <int dim>
    std::vector<VertexInFilm<dim>>
    vertices_in(const Film<dim> &film, const MovingMesh<dim> &mesh)
    {
      const std::vector<Image<dim>>  images   = mesh.scene().images();
      const bool                     mirrored = mesh.scene().mirrored();
      std::vector<VertexInFilm<dim>> result;
      for (const auto vertex : mesh.owned_scalars())
        if (mesh.vertex_master(vertex) == vertex)
          for (const Point<dim> &p :
               copies(images,
                      mirrored,
                      node_position<dim>(mesh.positions(),
                                         mesh.node_of_vertex(vertex))))
            {
              const double q = film.share(p);
              if (q > 0.)
                result.push_back({static_cast<unsigned int>(vertex), q, p});
            }
      return result;
    }



    /// The part of a form of pressure that has the symmetries of the scene.
    template <int dim>
    void
    set_pressure(FastVectorType                       &pressure,
                 const Film<dim>                      &film,
                 const Form<dim>                      &form,
                 const std::vector<VertexInFilm<dim>> &vertices)
    {
      // of copies that cancel
      constexpr double rounding = 1e-10;

      pressure = 0.f;
      for (unsigned int i = 0; i < vertices.size();)
        {
          const unsigned int vertex = vertices[i].vertex;
          double             sum    = 0.;
          for (; i < vertices.size() && vertices[i].vertex == vertex; ++i)
            sum += film.value(form, vertices[i].share, vertices[i].place);
          if (std::abs(sum) > rounding)
            pressure(vertex) = sum;
        }
    }
  } // namespace



  template <int dim>
  GapPressures<dim>::GapPressures(const MovingMesh<dim>    &mesh,
                                  const Configuration<dim> &configuration,
                                  const BlockMatrix<1>     &mass)
  {
    FastVectorType pressure, product;
    pressure.reinit(mesh.owned_scalars(), mesh.communicator());
    product.reinit(pressure);
    for (const Film<dim> &film : films(mesh.scene(), configuration))
      {
        if (size() >= most_pressures)
          break;
        const auto vertices = vertices_in(film, mesh);
        for (const Form<dim> &form : film.forms())
          {
            set_pressure(pressure, film, form, vertices);
            mass.vmult(product, pressure);
            const auto norm = [&]() {
              return std::sqrt(std::max(0.f, pressure * product));
            };
            const double whole = norm();
            // twice, as they may be nearly parallel
            for (unsigned int pass = 0; pass < 2; ++pass)
              {
                const std::vector<double> shares = products(product);
                for (unsigned int k = 0; k < shares.size(); ++k)
                  pressures.add_to(pressure, k, -shares[k]);
                mass.vmult(product, pressure);
              }
            const double remainder = norm();
            if (!(remainder > smallest_remainder * whole))
              continue;
            pressure *= 1. / remainder;
            product *= 1. / remainder;
            pressures.add(pressure);
            mass_products.add(product);
          }
      }
  }



  template <int dim>
  void
  GapPressures<dim>::remove(FastVectorType            &src,
                            const std::vector<double> &products) const
  {
    for (unsigned int k = 0; k < size(); ++k)
      mass_products.add_to(src, k, -products[k]);
  }



  template class GapPressures<2>;
  template class GapPressures<3>;
} // namespace Catena

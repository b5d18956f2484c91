#ifndef catena_base_archive_h
#define catena_base_archive_h

#include <catena/base/exceptions.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Values one after the other as bytes, in the representation of this
   * machine. The same function saves and loads an object, because an archive
   * knows which of the two it is for:
   * @code
   * void StepControl::archive(Archive &archive)
   * {
   *   archive(wanted, may_grow);
   * }
   * @endcode
   *
   * Numbers, enumerations, strings, points, tensors, vectors and arrays of
   * them, and objects with a member `archive(Archive &)` can be archived.
   * Strings and vectors are preceded by their length in 64 bits.
   */
  class Archive
  {
  public:
    /// An archive to save to.
    Archive() = default;

    /// An archive to load from.
    explicit Archive(std::string bytes)
      : content(std::move(bytes))
      , loading(true)
    {}

    bool
    is_loading() const
    {
      return loading;
    }

    /// All that has been saved to this archive.
    std::string
    bytes() const;

    /// The same in pieces, without a copy; the archive is empty then.
    std::vector<std::string>
    take_pieces()
    {
      return std::exchange(saved, {});
    }

    /**
     * Save or load @p values.
     * @throws CheckpointError if there is nothing like them to load
     */
    template <typename... T>
    void
    operator()(T &...values)
    {
      (value(values), ...);
    }

    /**
     * Nothing more is to be loaded.
     * @throws CheckpointError if there is more
     */
    void
    finish() const;

  private:
    /// a single string would be copied as it grows
    std::vector<std::string> saved;
    /// to load from
    std::string content;
    std::size_t position = 0;
    bool        loading  = false;

    void
    save(const char *data, std::size_t size);

    void
    raw(void *data, const std::size_t size);

    /// A number of entries, which the bytes that are left must be enough for.
    std::size_t
    length(const std::size_t present, const std::size_t smallest_entry);

    template <typename T>
    static constexpr bool is_plain =
      (std::is_arithmetic_v<T> || std::is_enum_v<T>)&&!std::is_same_v<T, bool>;

    template <typename T>
    void
    value(T &x)
    {
      if constexpr (is_plain<T>)
        raw(&x, sizeof(T));
      else
        x.archive(*this);
    }

    void
    value(bool &x);

    void
    value(std::string &x);

    template <int rank, int dim>
    void
    value(dealii::Tensor<rank, dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        value(x[d]);
    }

    template <int dim>
    void
    value(dealii::Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        value(x[d]);
    }

    template <typename T, std::size_t n>
    void
    value(std::array<T, n> &x)
    {
      for (T &entry : x)
        value(entry);
    }

    template <typename T>
    void
    value(std::vector<T> &x)
    {
      x.resize(length(x.size(), is_plain<T> ? sizeof(T) : 1));
      if constexpr (is_plain<T>)
        raw(x.data(), x.size() * sizeof(T));
      else
        for (T &entry : x)
          value(entry);
    }
  };
} // namespace Catena

#endif

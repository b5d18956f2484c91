#ifndef catena_mesh_gmsh_session_h
#define catena_mesh_gmsh_session_h

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Catena
{
  /**
   * Call @p function, to do what @p purpose says.
   * @throws MeshError for what gmsh throws
   */
  void
  call_gmsh(const std::string &purpose, const std::function<void()> &function);

  /// Set options of gmsh, and that it is silent and works on one thread.
  void
  set_gmsh_options(const std::vector<std::pair<std::string, double>> &options);

  /**
   * A model of gmsh, empty and current at first, there as long as this object.
   * gmsh is started with the first one and ends with the program.
   */
  class OwnedGmshModel
  {
  public:
    /// @throws MeshError if gmsh does not start
    OwnedGmshModel();
    ~OwnedGmshModel();

    OwnedGmshModel(const OwnedGmshModel &) = delete;

    OwnedGmshModel &
    operator=(const OwnedGmshModel &) = delete;

    void
    make_current() const;

  private:
    std::string name;
  };
} // namespace Catena

#endif

#include <catena/base/exceptions.h>
#include <catena/mesh/gmsh_session.h>

#include <gmsh.h>

#include <algorithm>

namespace Catena
{
  namespace
  {
    /// From the first model on until the program ends.
    class GmshSession
    {
    public:
      static void
      start()
      {
        static const GmshSession session;
      }

      ~GmshSession()
      {
        try
          {
            gmsh::finalize();
          }
        catch (...)
          {}
      }

    private:
      GmshSession()
      {
        gmsh::initialize(0, nullptr, false);
      }
    };
  } // namespace



  void
  call_gmsh(const std::string &purpose, const std::function<void()> &function)
  {
    const auto fail = [&](std::string reason) {
      std::replace(reason.begin(), reason.end(), '\n', ' ');
      throw MeshError("gmsh could not " + purpose + ": " + reason +
                      "; look for particles that nearly touch a plane, or "
                      "change the resolution");
    };
    try
      {
        function();
      }
    catch (const std::string &message)
      {
        fail(message);
      }
    catch (const int code)
      {
        fail("error " + std::to_string(code));
      }
  }



  void
  set_gmsh_options(const std::vector<std::pair<std::string, double>> &options)
  {
    for (const char *name : {"General.NumThreads",
                             "Mesh.MaxNumThreads1D",
                             "Mesh.MaxNumThreads2D",
                             "Mesh.MaxNumThreads3D"})
      gmsh::option::setNumber(name, 1);
    gmsh::option::setNumber("General.Terminal", 0);
    for (const auto &option : options)
      gmsh::option::setNumber(option.first, option.second);
  }



  OwnedGmshModel::OwnedGmshModel()
  {
    static unsigned int n_models = 0;
    name                         = "Catena" + std::to_string(n_models++);
    call_gmsh("start", [&]() {
      GmshSession::start();
      set_gmsh_options({});
      gmsh::model::add(name);
    });
  }



  OwnedGmshModel::~OwnedGmshModel()
  {
    try
      {
        gmsh::model::setCurrent(name);
        gmsh::model::remove();
      }
    catch (...)
      {
        // nothing to remove
      }
  }



  void
  OwnedGmshModel::make_current() const
  {
    gmsh::model::setCurrent(name);
  }
} // namespace Catena

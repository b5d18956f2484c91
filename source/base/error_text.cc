#include <catena/base/error_text.h>

#include <deal.II/base/exceptions.h>

#include <new>
#include <sstream>

namespace Catena
{
  using namespace dealii;

  std::string
  squeeze(const std::string &text)
  {
    std::istringstream words(text);
    std::string        result;
    for (std::string word; words >> word;)
      result += (result.empty() ? "" : " ") + word;
    return result;
  }



  std::string
  error_text(const std::exception &error)
  {
    const auto *const from_deal_ii =
      dynamic_cast<const ExceptionBase *>(&error);
    if (from_deal_ii == nullptr)
      return squeeze(error.what());

    std::ostringstream info;
    from_deal_ii->print_info(info);
    const std::string text = squeeze(info.str());
    return text.empty() || text == "(none)" ? from_deal_ii->get_exc_name() :
                                              text;
  }



  std::string
  error_place(const std::exception &error)
  {
    if (dynamic_cast<const ExceptionBase *>(&error) == nullptr)
      return "";

    const std::string text  = error.what();
    const std::string mark  = "An error occurred in ";
    const std::size_t begin = text.find(mark);
    const std::size_t end   = text.find(" in function", begin);
    if (begin == std::string::npos || end == std::string::npos)
      return "";
    return squeeze(text.substr(begin + mark.size(), end - begin - mark.size()));
  }



  std::string
  present_error_text()
  {
    try
      {
        throw;
      }
    catch (const std::bad_alloc &)
      {
        return "out of memory: use a coarser mesh or a larger machine";
      }
    catch (const std::exception &error)
      {
        const std::string place = error_place(error);
        return error_text(error) + (place.empty() ? "" : " (" + place + ")");
      }
    catch (const std::string &error) // thrown by gmsh
      {
        return "mesh generator: " + squeeze(error);
      }
    catch (...)
      {
        return "unknown exception";
      }
  }
} // namespace Catena

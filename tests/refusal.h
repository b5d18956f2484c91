#ifndef catena_tests_refusal_h
#define catena_tests_refusal_h

#include <catena/base/exceptions.h>

#include <string>

namespace Catena
{
  namespace Tests
  {
    /// The message with which input to @p function is refused; empty if it is
    /// accepted.
    template <typename Function>
    std::string
    refusal(const Function &function)
    {
      try
        {
          function();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    }
  } // namespace Tests
} // namespace Catena

#endif

#ifndef catena_base_exceptions_h
#define catena_base_exceptions_h

#include <sstream>
#include <stdexcept>
#include <string>

namespace Catena
{
  /**
   * Base of all errors Catena reports to a person: one line, what happened and
   * what to do about it.
   */
  class Error : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A parameter that cannot be used. The message is one line that names the
   * parameter, the value found and the remedy.
   */
  class InputError : public Error
  {
  public:
    template <typename T>
    InputError(const std::string &parameter,
               const T           &value,
               const std::string &remedy)
      : Error(message(parameter, value, remedy))
    {}

  private:
    template <typename T>
    static std::string
    message(const std::string &parameter,
            const T           &value,
            const std::string &remedy)
    {
      std::ostringstream text;
      text << "Parameter '" << parameter << "' = " << value << ": " << remedy;
      return text.str();
    }
  };

  /**
   * No acceptable mesh could be made after all retries.
   */
  class MeshError : public Error
  {
  public:
    using Error::Error;
  };

  /**
   * A linear or nonlinear solve did not reach its tolerance, or gave values
   * that are not finite.
   */
  class SolverError : public Error
  {
  public:
    using Error::Error;
  };

  /**
   * A checkpoint that cannot be written, or one that cannot be used: damaged,
   * of another version or of another run.
   */
  class CheckpointError : public Error
  {
  public:
    using Error::Error;
  };

  /**
   * A run that was asked to end by a signal, and did so in good order.
   */
  class Interrupted : public Error
  {
  public:
    Interrupted(const int signal, const std::string &message)
      : Error(message)
      , signal(signal)
    {}

    const int signal;
  };

  /**
   * Refuse an input: throw InputError unless @p acceptable.
   */
  template <typename T>
  void
  require(const bool         acceptable,
          const std::string &parameter,
          const T           &value,
          const std::string &remedy)
  {
    if (!acceptable)
      throw InputError(parameter, value, remedy);
  }
} // namespace Catena

#endif

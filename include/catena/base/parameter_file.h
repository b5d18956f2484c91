#ifndef catena_base_parameter_file_h
#define catena_base_parameter_file_h

#include <catena/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <istream>
#include <string>
#include <vector>

namespace Catena
{
  /**
   * A parameter file that cannot be used. The message is one line that names
   * file, line, parameter, value and remedy.
   */
  class ParameterFileError : public Error
  {
  public:
    using Error::Error;
  };

  /**
   * A `set` of a parameter file and where it was found.
   */
  struct ParameterSetting
  {
    /// Subsections from the outermost to the innermost.
    std::vector<std::string> path;

    std::string  name;
    std::string  value;
    std::string  file;
    unsigned int line = 0;

    /// "Mesh / Minimal gap"
    std::string
    full_name() const;
  };

  /**
   * Split a parameter file in the language of dealii::ParameterHandler
   * (`subsection`, `end`, `set`, `include`, `#`, a backslash at the end of a
   * continued line) into its settings, those of included files among them.
   * Values in braces, with which ParameterHandler would silently keep the
   * default, are refused.
   *
   * @param input The text.
   * @param file The name of the file, for messages.
   *
   * @throws ParameterFileError with one line that names file, line and remedy.
   */
  std::vector<ParameterSetting>
  scan_parameters(std::istream &input, const std::string &file);

  /**
   * Read the parameter file @p file and set the declared parameters. What
   * cannot be used is refused with one line that names file, line, parameter
   * with its subsection, value and remedy:
   * @code
   * quick.prm, line 12: unknown parameter 'Mesh / Minimal gpa' = 0.02: did
   * you mean 'Minimal gap'? (--template lists all)
   * @endcode
   *
   * @throws ParameterFileError
   */
  void
  read_parameters(dealii::ParameterHandler &prm, const std::string &file);
} // namespace Catena

#endif

#ifndef catena_base_error_text_h
#define catena_base_error_text_h

#include <exception>
#include <string>

namespace Catena
{
  /**
   * @p text with all line breaks and runs of blanks reduced to one blank.
   */
  std::string
  squeeze(const std::string &text);

  /**
   * The message of @p error in one line, without the banner that exceptions
   * of deal.II carry.
   */
  std::string
  error_text(const std::exception &error);

  /**
   * Where in the source an exception of deal.II was thrown, as "line <12> of
   * file <a.cc>"; empty for other exceptions.
   */
  std::string
  error_place(const std::exception &error);

  /**
   * What is to be said, in one line, about the exception that is being handled:
   * call it in a handler, which may be `catch (...)`.
   */
  std::string
  present_error_text();
} // namespace Catena

#endif

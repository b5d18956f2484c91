#include <catena/base/error_text.h>
#include <catena/base/parameter_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

namespace Catena
{
  using namespace dealii;

  namespace
  {
    const std::string see_template = "(--template lists all)";

    /// Included files may include further ones, but not themselves.
    constexpr unsigned int max_include_depth = 20;



    std::string
    join(const std::vector<std::string> &path)
    {
      std::string result;
      for (const std::string &part : path)
        result += (result.empty() ? "" : " / ") + part;
      return result;
    }



    [[noreturn]] void
    refuse(const std::string &file,
           const unsigned int line,
           const std::string &text)
    {
      throw ParameterFileError(file + ", line " + std::to_string(line) + ": " +
                               text);
    }



    /**
     * Number of letters to insert, delete or replace to turn @p a into @p b.
     */
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0U);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          unsigned int diagonal = std::exchange(row[0], i + 1);
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const unsigned int replaced =
                diagonal + (std::tolower(a[i]) != std::tolower(b[j]));
              diagonal   = row[j + 1];
              row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
            }
        }
      return row.back();
    }



    /**
     * "did you mean 'X'?" for the candidate nearest to @p name, or a remedy
     * without a proposal if none is near.
     */
    std::string
    proposal(const std::string &name, const std::set<std::string> &candidates)
    {
      std::string  nearest;
      unsigned int smallest = std::max<std::size_t>(2, name.size() / 3) + 1;
      for (const std::string &candidate : candidates)
        {
          const unsigned int distance = edit_distance(name, candidate);
          if (distance < smallest)
            {
              smallest = distance;
              nearest  = candidate;
            }
        }
      return nearest.empty() ? "remove it" : "did you mean '" + nearest + "'?";
    }



    /**
     * Reads one file; remembers the open subsections and where they were
     * opened.
     */
    class Scanner
    {
    public:
      Scanner(std::vector<ParameterSetting>  &settings,
              const std::string              &file,
              const std::vector<std::string> &path,
              const unsigned int              depth)
        : settings(settings)
        , file(file)
        , outer_path(path)
        , path(path)
        , depth(depth)
      {}

      void
      read(std::istream &input);

    private:
      std::vector<ParameterSetting> &settings;
      const std::string              file;
      const std::vector<std::string> outer_path;
      std::vector<std::string>       path;
      const unsigned int             depth;
      std::vector<unsigned int>      opened_at;
      unsigned int                   line = 0;

      void
      statement(const std::string &text);

      void
      set(const std::string &text);

      void
      leave();

      void
      include(const std::string &name);
    };



    void
    Scanner::read(std::istream &input)
    {
      std::string  text;
      unsigned int n_lines = 0;
      for (std::string part; std::getline(input, part);)
        {
          ++n_lines;
          if (text.empty())
            line = n_lines;

          text += Utilities::trim(part);
          if (!text.empty() && text.back() == '\\')
            text.pop_back();
          else
            statement(std::exchange(text, ""));
        }
      statement(text);

      if (!opened_at.empty())
        refuse(file,
               opened_at.back(),
               "subsection '" + join(path) +
                 "' is not closed: add a line 'end'");
    }



    void
    Scanner::statement(const std::string &text)
    {
      std::string words = text.substr(0, text.find('#'));
      std::replace(words.begin(), words.end(), '\t', ' ');
      words = Utilities::trim(words);
      if (words.empty())
        return;

      const std::size_t space   = words.find(' ');
      std::string       keyword = words.substr(0, space);
      const std::string rest =
        space == std::string::npos ? "" : Utilities::trim(words.substr(space));

      // As in deal.II: small letters or capitals, not both.
      if (keyword == "SET" || keyword == "SUBSECTION" || keyword == "END" ||
          keyword == "INCLUDE")
        std::transform(keyword.begin(),
                       keyword.end(),
                       keyword.begin(),
                       [](const unsigned char c) { return std::tolower(c); });

      if (keyword == "set")
        set(rest);
      else if (keyword == "subsection" && !rest.empty())
        {
          path.push_back(rest);
          opened_at.push_back(line);
        }
      else if (keyword == "end" && rest.empty())
        leave();
      else if (keyword == "include" && !rest.empty())
        include(rest);
      else
        refuse(file,
               line,
               "'" + words +
                 "' cannot be understood: write 'set NAME = VALUE', "
                 "'subsection NAME', 'end', 'include FILE' or '# comment'");
    }



    void
    Scanner::set(const std::string &text)
    {
      const std::size_t equals = text.find('=');
      const std::string name   = Utilities::trim(text.substr(0, equals));
      if (equals == std::string::npos || name.empty())
        refuse(file,
               line,
               "'set " + text +
                 "' cannot be understood: write 'set NAME = VALUE'");

      settings.push_back(
        {path, name, Utilities::trim(text.substr(equals + 1)), file, line});

      const ParameterSetting &setting = settings.back();
      if (setting.value.find('{') != std::string::npos)
        refuse(file,
               line,
               "parameter '" + setting.full_name() + "' = " + setting.value +
                 ": braces are not allowed, give one value");
    }



    void
    Scanner::leave()
    {
      if (opened_at.empty())
        refuse(file, line, "'end' without a subsection to close: remove it");
      path.pop_back();
      opened_at.pop_back();
    }



    void
    Scanner::include(const std::string &name)
    {
      std::ifstream input(name);
      if (!input || std::filesystem::is_directory(name))
        refuse(file,
               line,
               "cannot include '" + name +
                 "': name a file that can be read, seen from the directory "
                 "the program is started in");
      if (depth >= max_include_depth)
        refuse(file,
               line,
               "cannot include '" + name + "': files include each other");

      Scanner(settings, name, path, depth + 1).read(input);
    }



    /**
     * What the pattern that @p error complains about asks for, in words.
     */
    std::string
    wanted(const ParameterHandler::ExcValueDoesNotMatchPattern &error)
    {
      const std::string text  = error_text(error);
      const std::string mark  = "given pattern <";
      const std::size_t begin = text.find(mark);
      const std::size_t end   = text.rfind('>');
      if (begin == std::string::npos || end == std::string::npos)
        return text;

      const std::string pattern =
        text.substr(begin + mark.size(), end - begin - mark.size());
      try
        {
          std::string words = Patterns::pattern_factory(pattern)->description(
            Patterns::PatternBase::Text);
          words[0] = std::tolower(words[0]);
          for (const std::string no_bound :
               {" <= MAX_DOUBLE", "-MAX_DOUBLE <= "})
            words = Utilities::replace_in_string(words, no_bound, "");
          const std::string no_condition = " v such that v";
          if (words.size() > no_condition.size() &&
              words.substr(words.size() - no_condition.size()) == no_condition)
            words.resize(words.size() - no_condition.size());
          return "must be " + words;
        }
      catch (const std::exception &)
        {
          return "must be " + pattern;
        }
    }



    /**
     * All that is declared in @p prm.
     */
    std::vector<ParameterSetting>
    declared_parameters(const ParameterHandler &prm)
    {
      std::stringstream text;
      prm.print_parameters(text,
                           ParameterHandler::ShortPRM |
                             ParameterHandler::KeepDeclarationOrder);
      return scan_parameters(text, "declarations");
    }



    /**
     * Refuse @p setting, whose subsection does not exist.
     */
    [[noreturn]] void
    refuse_subsection(const ParameterHandler &prm,
                      const ParameterSetting &setting)
    {
      std::vector<std::string> known = setting.path;
      while (!known.empty() && !prm.subsection_path_exists(known))
        known.pop_back();
      const std::string unknown = setting.path[known.size()];

      std::set<std::string> candidates;
      for (const ParameterSetting &declared : declared_parameters(prm))
        if (declared.path.size() > known.size() &&
            std::equal(known.begin(), known.end(), declared.path.begin()))
          candidates.insert(declared.path[known.size()]);

      refuse(setting.file,
             setting.line,
             "parameter '" + setting.full_name() + "' = " + setting.value +
               ": unknown subsection '" + unknown +
               "': " + proposal(unknown, candidates) + ' ' + see_template);
    }



    /**
     * Refuse @p setting, whose name does not exist in its subsection.
     */
    [[noreturn]] void
    refuse_name(const ParameterHandler &prm, const ParameterSetting &setting)
    {
      std::string           remedy;
      std::set<std::string> candidates;
      for (const ParameterSetting &declared : declared_parameters(prm))
        {
          if (declared.path == setting.path)
            candidates.insert(declared.name);
          else if (declared.name == setting.name)
            remedy = declared.path.empty() ?
                       "move it out of all subsections" :
                       "move it to subsection '" + join(declared.path) + "'";
        }

      refuse(setting.file,
             setting.line,
             "unknown parameter '" + setting.full_name() +
               "' = " + setting.value + ": " +
               (remedy.empty() ? proposal(setting.name, candidates) : remedy) +
               ' ' + see_template);
    }



    void
    apply(ParameterHandler &prm, const ParameterSetting &setting)
    {
      if (!setting.path.empty() && !prm.subsection_path_exists(setting.path))
        refuse_subsection(prm, setting);

      for (const std::string &subsection : setting.path)
        prm.enter_subsection(subsection);
      const auto leave = [&]() {
        for (std::size_t i = 0; i < setting.path.size(); ++i)
          prm.leave_subsection();
      };

      const std::string parameter =
        "parameter '" + setting.full_name() + "' = " + setting.value + ": ";
      try
        {
          prm.set(setting.name, setting.value);
          leave();
        }
      catch (const ParameterHandler::ExcEntryUndeclared &)
        {
          leave();
          refuse_name(prm, setting);
        }
      catch (const ParameterHandler::ExcValueDoesNotMatchPattern &error)
        {
          leave();
          refuse(setting.file, setting.line, parameter + wanted(error));
        }
      catch (const std::exception &error)
        {
          leave();
          refuse(setting.file, setting.line, parameter + error_text(error));
        }
    }
  } // namespace



  std::string
  ParameterSetting::full_name() const
  {
    return path.empty() ? name : join(path) + " / " + name;
  }



  std::vector<ParameterSetting>
  scan_parameters(std::istream &input, const std::string &file)
  {
    std::vector<ParameterSetting> settings;
    Scanner(settings, file, {}, 0).read(input);
    return settings;
  }



  void
  read_parameters(ParameterHandler &prm, const std::string &file)
  {
    std::ifstream input(file);
    if (!input || std::filesystem::is_directory(file))
      throw ParameterFileError(
        "Parameter file '" + file +
        "' cannot be read: check the name, or write a new one with "
        "--template > " +
        file);

    for (const ParameterSetting &setting : scan_parameters(input, file))
      apply(prm, setting);

    const std::set<std::string> missing = prm.get_entries_wrongly_not_set();
    if (!missing.empty())
      throw ParameterFileError(file + ": parameter '" + *missing.begin() +
                               "' has no default: add a line that sets it " +
                               see_template);
  }
} // namespace Catena

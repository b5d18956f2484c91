// Whatever is wrong with a parameter file is said in one line that names the
// file, the line, the parameter with its subsection, the value and a remedy.

#include <catena/base/parameter_file.h>

#include <deal.II/base/patterns.h>

#include <cstdio>
#include <fstream>

#include "../tests.h"

using namespace Catena;

namespace
{
  /// The directory of a build is where tests run.
  const std::string file_name = "bad_parameter_file.prm";

  const std::string contact = "subsection Scene\nsubsection Contact\n";
  const std::string ends    = "\nend\nend\n";

  struct Parameters
  {
    double       gap   = 0.02;
    unsigned int count = 3;
    std::string  title = "none";

    void
    declare(dealii::ParameterHandler &prm)
    {
      prm.add_parameter("Title", title, "A title");
      prm.enter_subsection("Scene");
      prm.enter_subsection("Contact");
      prm.add_parameter("Minimal gap",
                        gap,
                        "Smallest gap, in 2 a",
                        dealii::Patterns::Double(0.));
      prm.leave_subsection();
      prm.add_parameter("Number of particles", count, "Particles");
      prm.leave_subsection();
    }
  };



  Parameters
  read(const std::string &text)
  {
    std::ofstream(file_name) << text;
    dealii::ParameterHandler prm;
    Parameters               parameters;
    parameters.declare(prm);
    read_parameters(prm, file_name);
    return parameters;
  }



  /**
   * Claim that @p text is refused with a line that holds all @p words.
   */
  void
  refused(Tests::Claims                  &claims,
          const std::string              &name,
          const std::string              &text,
          const std::vector<std::string> &words)
  {
    std::string message;
    try
      {
        read(text);
      }
    catch (const ParameterFileError &error)
      {
        message = error.what();
      }

    bool good = !message.empty() && message.find('\n') == std::string::npos;
    for (const std::string &word : words)
      good = good && message.find(word) != std::string::npos;
    claims.holds(name + (good ? "" : ": " + message), good);
  }



  void
  accepted(Tests::Claims &claims)
  {
    std::ofstream("included.prm") << "set Number of particles = 5\n";
    const Parameters good = read("# a comment\n"
                                 "set Title = one \\\n"
                                 "   line\n"
                                 "subsection Scene\n"
                                 "  include included.prm\n"
                                 "  subsection Contact # another\n"
                                 "    set Minimal gap = 0.5 # and another\n"
                                 "  end\n"
                                 "END\n");
    claims.near("value in a subsection", good.gap, 0.5, 0.);
    claims.near("value in an included file", good.count, 5., 0.);
    claims.holds("continued line", good.title == "one line");
    std::remove("included.prm");
  }



  void
  bad_names(Tests::Claims &claims)
  {
    refused(claims,
            "misspelt name",
            contact + "set Minimal gpa = 1" + ends,
            {file_name + ", line 3",
             "'Scene / Contact / Minimal gpa' = 1",
             "did you mean 'Minimal gap'?",
             "--template"});
    refused(claims,
            "unknown name",
            contact + "set Colour = red" + ends,
            {"line 3", "'Scene / Contact / Colour' = red", "remove it"});
    refused(claims,
            "right name in the wrong subsection",
            "set Minimal gap = 1\n",
            {"line 1", "'Minimal gap' = 1", "subsection 'Scene / Contact'"});
    refused(claims,
            "unknown subsection",
            "subsection Secne\nset Number of particles = 1\nend\n",
            {"line 2", "unknown subsection 'Secne'", "did you mean 'Scene'?"});
  }



  void
  bad_values(Tests::Claims &claims)
  {
    refused(claims,
            "negative size",
            contact + "set Minimal gap = -1" + ends,
            {"line 3", "'Scene / Contact / Minimal gap' = -1", "must be", "0"});
    refused(claims,
            "no number",
            contact + "set Minimal gap = wide" + ends,
            {"line 3", "Minimal gap' = wide", "must be"});
    refused(claims,
            "no integer",
            "subsection Scene\nset Number of particles = 2.5\nend\n",
            {"line 2", "'Scene / Number of particles' = 2.5", "must be"});
    refused(claims,
            "braces",
            "set Title = {1|2}\n",
            {"line 1", "'Title' = {1|2}", "braces"});
  }



  void
  bad_language(Tests::Claims &claims)
  {
    refused(claims,
            "no equals sign",
            "\n\nset Title none\n",
            {"line 3", "set Title none", "set NAME = VALUE"});
    refused(claims,
            "no keyword",
            "Title = none\n",
            {"line 1", "'Title = none'", "set NAME = VALUE"});
    refused(claims,
            "subsection that is not closed",
            contact + "set Minimal gap = 1\nend\n",
            {"line 1", "'Scene'", "not closed"});
    refused(claims, "end too many", "end\n", {"line 1", "'end' without"});
    refused(claims,
            "missing include",
            "include nowhere.prm\n",
            {"line 1", "'nowhere.prm'"});
  }



  void
  missing_file(Tests::Claims &claims)
  {
    std::remove(file_name.c_str());
    bool missing = false;
    try
      {
        dealii::ParameterHandler prm;
        read_parameters(prm, file_name);
      }
    catch (const ParameterFileError &error)
      {
        missing =
          std::string(error.what()).find(file_name) != std::string::npos;
      }
    claims.holds("missing file", missing);
  }



  void
  test(Tests::Claims &claims)
  {
    accepted(claims);
    bad_names(claims);
    bad_values(claims);
    bad_language(claims);
    missing_file(claims);
  }
} // namespace



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, test);
}

// Carreau parameters are read from a .prm, and those that cannot be used are
// refused with a message that names the parameter, its value and a remedy.

#include <catena/base/exceptions.h>
#include <catena/rheology/carreau.h>

#include <limits>
#include <string>

#include "../tests.h"

using namespace Catena;

CarreauParameters
read(const std::string &entries)
{
  CarreauParameters        parameters;
  dealii::ParameterHandler prm;
  parameters.declare(prm);
  prm.parse_input_from_string(entries);
  return parameters;
}



/// The message that refuses the parameters; empty if none does.
std::string
refusal(const CarreauParameters &parameters)
{
  try
    {
      Carreau model(parameters);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}



bool
is_refused(const std::string &entry,
           const std::string &value,
           const std::string &remedy)
{
  const std::string message = refusal(read("set " + entry + " = " + value));
  return message.find("'" + entry + "' = " + value) != std::string::npos &&
         message.find(remedy) != std::string::npos &&
         message.find('\n') == std::string::npos;
}



int
main(int argc, char **argv)
{
  return Tests::run(argc, argv, [](Tests::Claims &claims) {
    const CarreauParameters parameters = read("set Carreau time = 2.5\n"
                                              "set Power index  = 0.3\n");
    claims.near("lambda_c is read", parameters.carreau_time, 2.5, 0.);
    claims.near("n is read", parameters.power_index, 0.3, 0.);

    claims.holds("the defaults can be used", refusal(read("")).empty());
    claims.holds("the ends of the ranges can be used",
                 refusal(read("set Carreau time = 0")).empty() &&
                   refusal(read("set Power index = 2")).empty());

    claims.holds("a negative lambda_c is refused",
                 is_refused("Carreau time", "-1.5", "not negative"));
    claims.holds("n = 0 is refused",
                 is_refused("Power index", "0", "must be positive"));
    claims.holds("a negative n is refused",
                 is_refused("Power index", "-0.5", "must be positive"));
    claims.holds("n > 2 is refused",
                 is_refused("Power index", "2.5", "at most 2"));

    CarreauParameters unusable;
    unusable.power_index = std::numeric_limits<double>::quiet_NaN();
    claims.holds("n that is not a number is refused",
                 !refusal(unusable).empty());
    unusable              = CarreauParameters();
    unusable.carreau_time = std::numeric_limits<double>::infinity();
    claims.holds("an infinite lambda_c is refused", !refusal(unusable).empty());
  });
}

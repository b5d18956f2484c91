// Parameters are read from a .prm, and those that cannot be used are refused
// with a message that names the parameter, its value and a remedy.

#include <catena/base/exceptions.h>
#include <catena/rheology/giesekus.h>
#include <catena/rheology/shear_flow.h>

#include <limits>
#include <string>

#include "../tests.h"

using namespace Catena;

GiesekusParameters
read(const std::string &entries)
{
  GiesekusParameters       parameters;
  dealii::ParameterHandler prm;
  parameters.declare(prm);
  prm.parse_input_from_string(entries);
  return parameters;
}



/// The message that refuses these entries of a .prm; empty if none does.
std::string
refusal(const std::string &entries)
{
  const GiesekusParameters parameters = read(entries);
  try
    {
      parameters.check();
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}



bool
names(const std::string &message, const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    if (message.find(part) == std::string::npos)
      return false;
  return true;
}



int
main(int argc, char **argv)
{
  return Catena::Tests::run(argc, argv, [](Catena::Tests::Claims &claims) {
    const GiesekusParameters parameters =
      read("set Weissenberg number      = 2.5\n"
           "set Mobility parameter      = 0.2\n"
           "set Solvent viscosity ratio = 0.25\n");
    claims.near("Wi is read", parameters.weissenberg_number, 2.5, 0.);
    claims.near("alpha is read", parameters.mobility_parameter, 0.2, 0.);
    claims.near("beta is read", parameters.solvent_viscosity_ratio, 0.25, 0.);

    const Giesekus<3> model(parameters);
    claims.near("lambda = Wi", model.relaxation_time(), 2.5, 0.);
    claims.near("G = (1 - beta)/lambda", model.modulus(), 0.3, 1e-16);
    claims.near("eta_s = beta", model.solvent_viscosity(), 0.25, 0.);

    claims.holds("the defaults can be used", refusal("").empty());
    claims.holds("the ends of the ranges can be used",
                 refusal("set Mobility parameter = 0").empty() &&
                   refusal("set Mobility parameter = 1").empty() &&
                   refusal("set Solvent viscosity ratio = 0").empty());

    claims.holds("a negative Wi is refused",
                 names(refusal("set Weissenberg number = -1.5"),
                       {"'Weissenberg number' = -1.5", "must be positive"}));
    claims.holds("Wi = 0 is sent to Newtonian",
                 names(refusal("set Weissenberg number = 0"),
                       {"'Weissenberg number' = 0",
                        "'Fluid/Model' = newtonian"}));
    claims.holds("a negative alpha is refused",
                 names(refusal("set Mobility parameter = -0.1"),
                       {"'Mobility parameter' = -0.1", "between 0"}));
    claims.holds("alpha > 1 is refused",
                 names(refusal("set Mobility parameter = 1.1"),
                       {"'Mobility parameter' = 1.1", "and 1"}));
    claims.holds("a negative beta is refused",
                 names(refusal("set Solvent viscosity ratio = -0.1"),
                       {"'Solvent viscosity ratio' = -0.1", "at least 0"}));
    claims.holds("beta > 1 is refused",
                 names(refusal("set Solvent viscosity ratio = 1.5"),
                       {"'Solvent viscosity ratio' = 1.5", "less than 1"}));
    claims.holds("beta = 1 is sent to Newtonian",
                 names(refusal("set Solvent viscosity ratio = 1"),
                       {"'Solvent viscosity ratio' = 1",
                        "'Fluid/Model' = newtonian"}));

    GiesekusParameters unusable;
    unusable.mobility_parameter = std::numeric_limits<double>::quiet_NaN();
    bool model_refuses = false, closed_form_refuses = false;
    try
      {
        Giesekus<2> refused(unusable);
      }
    catch (const InputError &)
      {
        model_refuses = true;
      }
    try
      {
        steady_shear(unusable);
      }
    catch (const InputError &)
      {
        closed_form_refuses = true;
      }
    claims.holds("the model refuses what is not a number", model_refuses);
    claims.holds("the closed form refuses what is not a number",
                 closed_form_refuses);
  });
}

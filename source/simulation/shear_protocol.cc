#include <catena/simulation/shear_protocol.h>

#include <algorithm>

namespace Catena
{
  ShearProtocol::ShearProtocol(const SimulationParameters &parameters,
                               const bool                  starts_held,
                               const bool                  walls_move)
    : held_for(starts_held ? parameters.fluid.giesekus.weissenberg_number : 0.)
    , wall_rate(walls_move ? 1. : 0.)
    , release(parameters.release_strain)
    , end(parameters.final_strain)
    , reversals(parameters.reversal_strains)
    , instants(parameters.field_strains)
  {
    instants.insert(instants.end(), reversals.begin(), reversals.end());
    if (starts_held)
      instants.insert(instants.end(), {0., release});
  }



  double
  ShearProtocol::start() const
  {
    // not minus zero
    return 0. - held_for;
  }



  bool
  ShearProtocol::holds(const double time) const
  {
    return held_for > 0. && time < -same_strain;
  }



  double
  ShearProtocol::shear_rate(const double time) const
  {
    double rate = wall_rate;
    for (const double reversal : reversals)
      if (reversal <= time + same_strain)
        rate *= -1.;
    return rate;
  }



  double
  ShearProtocol::holding_share(const double time) const
  {
    return std::clamp(1. - time / release, 0., 1.);
  }



  double
  ShearProtocol::next_instant(const double time) const
  {
    double next = end;
    for (const double instant : instants)
      if (instant > time + same_strain)
        next = std::min(next, instant);
    return next;
  }
} // namespace Catena

#ifndef catena_simulation_shear_protocol_h
#define catena_simulation_shear_protocol_h

#include <catena/simulation/parameters.h>

#include <vector>

namespace Catena
{
  /**
   * What is imposed, and when. A viscoelastic stress builds up around particles
   * that are held in place for one relaxation time, t in [-Wi, 0]; the forces
   * that held them then go to zero over the release strain, linearly. The walls
   * turn back at the reversal strains. Times t are in 1/gamma.
   */
  class ShearProtocol
  {
  public:
    /// Strains that differ by less do so by rounding only.
    static constexpr double same_strain = 1e-9;

    /**
     * @p starts_held: are there particles to be held at first?
     * @p walls_move: or does a pressure drop drive the flow?
     */
    ShearProtocol(const SimulationParameters &parameters,
                  const bool                  starts_held,
                  const bool                  walls_move);

    /// 0, or minus the time in which particles are held.
    double
    start() const;

    /// Are the particles held from @p time on?
    bool
    holds(const double time) const;

    /// Rate of the imposed shear from @p time on [gamma].
    double
    shear_rate(const double time) const;

    /// Part of the holding forces that is left at @p time.
    double
    holding_share(const double time) const;

    /// The first instant after @p time over which no step may go: something
    /// changes there, the fields are asked for, or it is the end.
    double
    next_instant(const double time) const;

  private:
    double              held_for;
    double              wall_rate;
    double              release;
    double              end;
    std::vector<double> reversals;
    std::vector<double> instants;
  };
} // namespace Catena

#endif

#include "observables/energy.hpp"

namespace clatter::observables {

std::vector<Column<Energy::Values>> Energy::columns(const Settings&) {
  const Coordinate stop = stop_coordinate();
  return {
      in_relative_frame(in_si("work of the force and the load in the observed time",
                              scalar("work_in", "work of the force and the load in the observed time, per unit mass",
                                     &Values::work_in, Quantity::energy))),
      in_relative_frame(in_si("energy lost to damping in the observed time",
                              scalar("loss_damping", "energy lost to damping in the observed time, per unit mass",
                                     &Values::loss_damping, Quantity::energy))),
      in_si("energy lost in impacts in the observed time",
            pair("loss_impact", "energy lost in impacts in the observed time, per unit mass", stop,
                 &Values::loss_impact, Quantity::energy)),
      in_si("impulse on the stop in the observed time",
            pair("impulse", "impulse on the stop in the observed time, per unit mass", stop, &Values::impulse,
                 Quantity::impulse)),
      in_relative_frame(in_si("work less losses and growth of the energy",
                              scalar("energy_residual", "work less losses and growth of the energy, per unit mass",
                                     &Values::energy_residual, Quantity::energy))),
      in_si("energy lost in impacts per second", scalar("impact_power", "energy lost in impacts per tau, per unit mass",
                                                        &Values::impact_power, Quantity::power))};
}

}  // namespace clatter::observables

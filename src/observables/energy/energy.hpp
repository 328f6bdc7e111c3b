#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// The energy ledger of the observed time, per unit mass (eqs. 31 to 34). The energy is (x'^2 + k x^2)/2, and that of
/// the springs of soft stops beyond whose position the mass is (eq. 54); the work of the force and the load, less the
/// losses by damping, dry friction and on the stops, is its growth, and the residual says how well this holds.
///
/// That of a loose mass is added (eq. 74).
///
/// Work and damping are integrated over each arc by Gauss-Legendre quadrature, exact to rounding.
struct Energy {
  struct Settings {
    bool energy = false;
    bool of_friction = false;  ///< with it: what only dry friction takes
    bool wall_energy = false;  ///< with it: that of a loose mass beside a main mass with stops or friction
  };
  struct Values {
    double work_in = no_value, loss_damping = no_value, loss_friction = no_value;
    std::array<double, 2> loss_impact{no_value, no_value};  ///< [stop]
    std::array<double, 2> impulse{no_value, no_value};      ///< [stop]: of impacts, and of the force pressing at rest
    std::array<double, 2> wall_loss_impact{no_value, no_value};  ///< [wall]
    std::array<double, 2> wall_impulse{no_value, no_value};      ///< [wall]: of impacts, and of the wall pressing
    double energy_residual = no_value;                           ///< work less losses and growth: 0 but for rounding
    double impact_power = no_value;                              ///< loss by all impacts over the observed time
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "energy", Kind::flag, "false", "true",
                "energy balance, in [scene] per unit mass: work of force and load, "
                "losses by damping, dry friction and impacts, impulse on the stops, impact power"},
            &Settings::energy}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.energy; }
  [[nodiscard]] static std::string description(const Settings&) { return "energy"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    const Coordinate stop = stop_coordinate();
    std::vector<Column<Values>> all{
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
        in_si("energy lost in impacts per second",
              scalar("impact_power", "energy lost in impacts per tau, per unit mass", &Values::impact_power,
                     Quantity::power))};
    if (settings.wall_energy) {
      all.push_back(
          in_si("energy lost in impacts of the loose mass in the observed time",
                pair("wall_loss_impact",
                     "energy lost in impacts of the loose mass in the observed time, per unit of the main mass", stop,
                     &Values::wall_loss_impact, Quantity::energy)));
      all.push_back(in_si("impulse on the wall in the observed time",
                          pair("wall_impulse", "impulse on the wall in the observed time, per unit of the main mass",
                               stop, &Values::wall_impulse, Quantity::impulse)));
    }
    if (settings.of_friction)
      all.push_back(in_relative_frame(
          in_si("energy lost to dry friction in the observed time",
                scalar("loss_friction", "energy lost to dry friction in the observed time, per unit mass",
                       &Values::loss_friction, Quantity::energy))));
    return all;
  }

  class Observer;  ///< in energy_observer.hpp
};

}  // namespace clatter::observables

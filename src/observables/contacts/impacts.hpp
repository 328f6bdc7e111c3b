#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "observables/extremes/range.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// Counts impacts and sums the time at rest, for each stop; of soft stops the contacts, the time in contact, and the
/// greatest force.
struct Impacts {
  struct Settings {
    bool impacts = false;
    bool of_soft_stops = false;  ///< with it: what only soft stops have
    bool of_sticks = false;      ///< with it: the share of time in which dry friction holds the mass
    bool loose_impacts = false;  ///< they are those of a loose mass, on walls in place of stops
    bool wall_impacts = false;   ///< with it: those of a loose mass beside those of a main mass with stops or friction
    bool of_soft_walls = false;  ///< with these: what only soft walls have
  };
  struct Values {
    std::array<double, 2> impacts_per_period{no_value, no_value};  ///< [stop]
    std::array<double, 2> v_before{no_value, no_value}, v_after{no_value, no_value};
    std::array<double, 2> impact_speed{no_value, no_value};
    std::array<double, 2> rest_fraction{no_value, no_value};
    double stick_fraction = no_value;
    std::array<double, 2> contact_fraction{no_value, no_value}, contact_force_max{no_value, no_value};
    std::array<double, 2> wall_impacts_per_period{no_value, no_value};  ///< [wall]
    std::array<double, 2> wall_v_before{no_value, no_value}, wall_v_after{no_value, no_value};
    std::array<double, 2> wall_impact_speed{no_value, no_value};
    std::array<double, 2> wall_rest_fraction{no_value, no_value};
    std::array<double, 2> wall_contact_fraction{no_value, no_value}, wall_contact_force_max{no_value, no_value};
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "impacts", Kind::flag, "false", "true",
                "for each stop: impacts per period, velocity before and after the "
                "first, speed of the fastest, share of time at rest; under dry friction the share "
                "of time stuck elsewhere"},
            &Settings::impacts}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.impacts; }
  [[nodiscard]] static std::string description(const Settings&) { return "impacts"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    const Coordinate stop = stop_coordinate();
    const bool loose = settings.loose_impacts;
    const std::string_view not_hit = loose ? "the wall isn't hit" : "the stop isn't hit";
    const char* const rest = loose ? "share of time pressed on the wall" : "share of time at rest on the stop";
    std::vector<Column<Values>> all{
        pair("impacts_per_period", "impacts per forcing period", stop, &Values::impacts_per_period),
        missing_if(not_hit, in_relative_frame(pair("v_before", "velocity before the first impact", stop,
                                                   &Values::v_before, Quantity::velocity))),
        missing_if(loose ? not_hit : "the stop isn't hit, or a transient ends in the first contact with a soft one",
                   in_relative_frame(
                       pair("v_after", "velocity after the first impact", stop, &Values::v_after, Quantity::velocity))),
        missing_if(not_hit, in_relative_frame(pair("impact_speed", "speed of the fastest impact", stop,
                                                   &Values::impact_speed, Quantity::velocity))),
        pair("rest_fraction", rest, stop, &Values::rest_fraction)};
    if (settings.wall_impacts) add_walls(settings, all);
    if (settings.of_sticks)
      all.push_back(scalar("stick_fraction", "share of time in which dry friction holds the mass away from rigid stops",
                           &Values::stick_fraction));
    if (!settings.of_soft_stops) return all;
    all.push_back(pair("contact_fraction",
                       loose ? "share of time in contact with the wall" : "share of time in contact with the stop",
                       stop, &Values::contact_fraction));
    add_force(all, loose, "contact_force_max", &Values::contact_force_max);
    return all;
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }
  /// Adds the columns of a loose mass beside those of the stops.
  static void add_walls(const Settings& settings, std::vector<Column<Values>>& all) {
    const Coordinate wall = stop_coordinate();
    const auto of_hit = [&](Column<Values> column) { all.push_back(missing_if("the wall isn't hit", column)); };
    all.push_back(pair("wall_impacts_per_period", "impacts on the wall per forcing period", wall,
                       &Values::wall_impacts_per_period));
    of_hit(pair("wall_v_before", "velocity z' of the loose mass before the first impact", wall, &Values::wall_v_before,
                Quantity::velocity));
    of_hit(pair("wall_v_after", "velocity z' of the loose mass after the first impact", wall, &Values::wall_v_after,
                Quantity::velocity));
    of_hit(pair("wall_impact_speed", "speed of the fastest impact of the loose mass", wall, &Values::wall_impact_speed,
                Quantity::velocity));
    all.push_back(pair("wall_rest_fraction", "share of time pressed on the wall", wall, &Values::wall_rest_fraction));
    if (!settings.of_soft_walls) return;
    all.push_back(
        pair("wall_contact_fraction", "share of time in contact with the wall", wall, &Values::wall_contact_fraction));
    add_force(all, true, "wall_contact_force_max", &Values::wall_contact_force_max);
  }
  /// Adds the greatest force of soft stops, or walls.
  static void add_force(std::vector<Column<Values>>& all, bool is_of_wall, const char* name,
                        std::array<double, 2> Values::*force) {
    const Coordinate stop = stop_coordinate();
    if (is_of_wall)
      all.push_back(missing_if("the wall is rigid, or isn't there",
                               in_si("greatest force of the soft wall",
                                     pair(name, "greatest force of the soft wall, per unit of the main mass", stop,
                                          force, Quantity::force))));
    else
      all.push_back(missing_if(
          "the stop is rigid, or isn't there",
          in_si("greatest force of the soft stop",
                pair(name, "greatest force of the soft stop, per unit mass", stop, force, Quantity::force))));
  }

  struct OfStop {
    double count = 0.0;
    double before = no_value;      ///< velocity before the first impact, signed
    double after = no_value;       ///< velocity after it
    double fastest = 0.0;          ///< speed of the fastest impact
    double left_first = no_value;  ///< velocity at the end of the first contact with a soft stop that ends
    double rest_time = 0.0;        ///< in tau
    double contact_time = 0.0;     ///< with a soft stop, in tau
    Range force{};                 ///< of a soft stop, while in contact

    /// An impact or a touch with a velocity.
    void meet(double velocity) {
      if (count == 0.0) before = velocity;
      count += 1.0, fastest = std::max(fastest, std::abs(velocity));
    }
  };

  class Observer;  ///< in impacts_observer.hpp
};

}  // namespace clatter::observables

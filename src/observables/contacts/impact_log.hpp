#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "motion/event.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// An impact, or the touch of a soft stop, as the log keeps it.
struct LoggedImpact {
  double time = 0.0;           ///< tau since the observed time began
  double before = 0.0;         ///< velocity before it, relative to what is shaken
  double after = 0.0;          ///< velocity after it, too
  double phase = no_value;     ///< forcing phase theta, rad, in [0, 2 pi); NaN if nothing drives the mass
  double absolute = no_value;  ///< velocity before it as seen from the ground
  std::int8_t stop = 0;        ///< -1: lower, +1: upper; -2 and +2: the walls of a loose mass beside stops
};

/// A variable of the file over all impacts, and the number of an impact that it holds.
struct LogColumn {
  std::string_view name, long_name;
  double LoggedImpact::*member;
  Quantity quantity;
  FrameOf frame = FrameOf::any;
  std::string_view missing_if{};  ///< as of results
};

/// The numbers of the log in the order of the file; the last one exists if stops or base are shaken.
inline constexpr std::array log_columns_of_shaken{
    LogColumn{"impact_tau", "time of the impact since the beginning of the observed time", &LoggedImpact::time,
              Quantity::time},
    LogColumn{"impact_v_before", "velocity before the impact", &LoggedImpact::before, Quantity::velocity,
              FrameOf::relative},
    LogColumn{"impact_v_after", "velocity after the impact", &LoggedImpact::after, Quantity::velocity,
              FrameOf::relative, "the contact with a soft stop goes on beyond the observed time"},
    LogColumn{"impact_phase", "forcing phase of the impact", &LoggedImpact::phase, Quantity::angle},
    LogColumn{"impact_v_before_absolute", "velocity before the impact", &LoggedImpact::absolute, Quantity::velocity,
              FrameOf::absolute}};

[[nodiscard]] inline std::span<const LogColumn> log_columns(bool is_shaken) {
  return std::span(log_columns_of_shaken).first(log_columns_of_shaken.size() - (is_shaken ? 0 : 1));
}

/// Keeps every impact. As many as there are, they have no column: results hold them one point after the other.
struct ImpactLog {
  struct Settings {
    bool impact_log = false;
    bool wall_log = false;  ///< with it: walls of a loose mass are told from stops
    bool full_log = false;  ///< with it: every rest and completed chatter, and an impact at the beginning itself
  };
  struct Values {
    std::vector<LoggedImpact> log{};
    std::vector<motion::Event> rests{};  ///< of a loose mass as in its housing
  };
  static constexpr std::tuple fields{Field{Key{"observe", "impact_log", Kind::flag, "false", "true",
                                               "log of every observed impact: time, stop, velocities, forcing phase"},
                                           &Settings::impact_log}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.impact_log || settings.full_log; }
  [[nodiscard]] static std::string description(const Settings&) { return "impact log"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) { return {}; }

  class Observer;  ///< in impact_log_observer.hpp
};

}  // namespace clatter::observables

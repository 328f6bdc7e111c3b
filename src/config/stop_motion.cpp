#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "config/consistency.hpp"
#include "config/force_shape.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

constexpr std::array<Parameter, 2> amplitudes{"stop_amplitude_lower", "stop_amplitude_upper"};

/// An amplitude of a stop by itself that isn't 0 at some point.
struct Moved {
  const SourceLocation* place = nullptr;  ///< nullptr: no stop moves by itself
  std::string name{};
};
Moved moved_of(const Settings& settings) {
  for (const Parameter amplitude : amplitudes)
    if (const SourceLocation* const place = place_of_nonzero(settings.given(amplitude)))
      return {place, in_quotes(amplitude.key())};
  return {};
}

[[noreturn]] void refuse(const Moved& moved, const std::string& what, const std::string& way_out) {
  fail(*moved.place, moved.name + " beside " + what + "; " + way_out);
}

/// Throws ConfigError if something is asked for that isn't known of stops that move by themselves.
void refuse_others(const Settings& settings, const Moved& moved) {
  const auto given = [&](const Parameter& key) { return place_of_nonzero(settings.given(key)) != nullptr; };
  for (const Parameter level : std::array<Parameter, 2>{"friction", "friction_static"})
    if (given(level)) refuse(moved, in_quotes(level.key()), "leave out one of them, or let both stops move alike");
  if (has_loose_mass(settings)) refuse(moved, "'loose_mass'", "leave out one of them");
  if (has_force_in_pieces(settings))
    refuse(moved, in_quotes(key_of_shape(settings)),
           "a stop moves as a sine, so far beside a force of sines: leave out one of them");
  if (settings.given("start_period") != nullptr)
    refuse(moved, "'start_period'", "that is of motion between standing stops: give x0 and v0 instead");
  if (const std::string method = settings.text("integrator", "method"); method != "exact")
    refuse(moved, "method = " + in_quotes(method), "such stops are computed by the exact method alone: leave it out");
  if (!settings.text("observe", "sensitivity").empty())
    refuse(moved, "'sensitivity'", "derivatives aren't known of stops that move by themselves: leave it out");
  if (settings.find("branch", "along") != nullptr)
    refuse(moved, "[branch]", "a branch needs stops that move alike: give stop_amplitude, or sweep.follow");
}

Parameter key_of_stiffness(const Settings& settings, Side side) {
  if (settings.given("stop_stiffness") != nullptr) return "stop_stiffness";
  return side == Side::lower ? Parameter("stop_stiffness_lower") : Parameter("stop_stiffness_upper");
}

/// The numbers of a scene that decide where stops are, at each point at which they differ.
class Places {
 public:
  Places(const Settings& settings, const AxisGroups& groups) {
    const bool symmetric = settings.given_symmetric_stops() != nullptr;
    const Parameter both = settings.is_si() ? Parameter("gap") : Parameter("xs");
    const auto of = [&](Parameter key) { return placed(settings, groups, key); };
    const std::string name = settings.is_si() ? "gap" : "|xs|";
    of_ = {symmetric ? mirrored(of(both), -1, name) : of("stop_lower"),
           symmetric ? mirrored(of(both), 1, name) : of("stop_upper"),
           of("stop_amplitude_lower"),
           of("stop_amplitude_upper"),
           of("stop_phase_lower"),
           of("stop_phase_upper"),
           of("stop_phase"),
           of("phase"),
           of("x0"),
           of(key_of_stiffness(settings, Side::lower)),
           of(key_of_stiffness(settings, Side::upper))};
    for (const Placed& each : of_)
      if (each.dimension && std::ranges::find(dimensions_, *each.dimension) == dimensions_.end())
        dimensions_.push_back(*each.dimension), lengths_.push_back(each.values.size());
  }
  enum What : std::size_t {
    lower,
    upper,
    amplitude_lower,
    amplitude_upper,
    lead_lower,
    lead_upper,
    lead,
    phase,
    start,
    stiffness_lower,
    stiffness_upper
  };

  /// Whether each place, with all that the others may be, shows that stops keep apart, and the mass starts between
  /// them.
  [[nodiscard]] bool are_apart() const {
    const auto most = [&](What what) { return std::ranges::max(of_[what].values); };
    const auto least = [&](What what) { return std::ranges::min(of_[what].values); };
    const auto largest = [&](What what) { return std::max(std::abs(most(what)), std::abs(least(what))); };
    const double bottom = most(lower) + largest(amplitude_lower), top = least(upper) - largest(amplitude_upper);
    return bottom < top && bottom <= least(start) && most(start) <= top;
  }

  [[nodiscard]] std::size_t points() const {
    std::size_t points = 1;
    for (const std::size_t length : lengths_) points *= length;
    return points;
  }
  [[nodiscard]] double at(What what, std::size_t point) const { return of_[what].values[index(what, point)]; }
  /// Where a setting is given that has its value there.
  [[nodiscard]] const SourceLocation* location(What what, std::size_t point) const {
    const Setting* const given = of_[what].given;
    return given != nullptr ? &given->location_of(index(what, point)) : nullptr;
  }
  [[nodiscard]] bool is_first(std::optional<std::size_t> dimension, std::size_t point) const {
    const auto found = std::ranges::find(dimensions_, dimension.value_or(dimensions_.size()));
    return !dimension || found == dimensions_.end() ||
           along(static_cast<std::size_t>(found - dimensions_.begin()), point) == 0;
  }

 private:
  [[nodiscard]] std::size_t along(std::size_t dimension, std::size_t point) const {
    for (std::size_t d = 0; d < dimension; ++d) point /= lengths_[d];
    return point % lengths_[dimension];
  }
  [[nodiscard]] std::size_t index(What what, std::size_t point) const {
    if (!of_[what].dimension) return 0;
    const auto found = std::ranges::find(dimensions_, *of_[what].dimension);
    return along(static_cast<std::size_t>(found - dimensions_.begin()), point);
  }

  std::array<Placed, 11> of_;
  std::vector<std::size_t> dimensions_{}, lengths_{};
};

/// Throws ConfigError if the stops come together, or if a mass doesn't start between rigid ones.
void check_places(const Settings& settings, const AxisGroups& groups, const Moved& moved) {
  const Places places(settings, groups);
  if (places.are_apart()) return;
  const auto followed = followed_dimension(settings, groups);
  constexpr std::size_t most = 4'000'000;
  const std::size_t points = places.points();
  if (points > most)
    refuse(moved, "so many values of what decides where stops are",
           "at most 4,000,000 places can be compared: take fewer, or a gap in which they keep apart at any phase");
  for (std::size_t point = 0; point < points; ++point) {
    const auto at = [&](Places::What what) { return places.at(what, point); };
    const double lower = at(Places::lower), upper = at(Places::upper), turned = at(Places::lead_upper),
                 b = at(Places::amplitude_lower), c = at(Places::amplitude_upper),
                 apart = turned - at(Places::lead_lower);
    const double approach = std::hypot(c * std::cos(apart) - b, c * std::sin(apart));
    if (!(upper - lower > approach)) {
      const Places::What what = c != 0 ? Places::amplitude_upper : Places::amplitude_lower;
      const SourceLocation* const place = places.location(what, point);
      fail(place != nullptr ? *place : *moved.place,
           "the stops come together, as they are " + number_text(upper - lower) + " apart and their motion takes " +
               number_text(approach) + " from that; expected less: give smaller amplitudes, or a wider gap");
    }
    if (!places.is_first(followed, point)) continue;
    const double theta = at(Places::phase) + at(Places::lead), x0 = at(Places::start);
    const auto check = [&](Side side, double stop) {
      if (is_finite(at(side == Side::lower ? Places::stiffness_lower : Places::stiffness_upper))) return;  // a soft one
      const double rounding = 1e-14 * (std::abs(stop) + std::abs(b) + std::abs(c));
      if (sign_of(side) * (x0 - stop) <= rounding) return;
      const SourceLocation* const place = places.location(Places::start, point);
      fail(place != nullptr ? *place : *moved.place,
           "x0 = " + number_text(x0) + " lies beyond the " + (side == Side::lower ? "lower" : "upper") +
               " stop, which is at " + number_text(stop) + " at the start; expected a start between the stops");
    };
    check(Side::lower, lower + b * std::sin(theta + at(Places::lead_lower)));
    check(Side::upper, upper + c * std::sin(theta + turned));
  }
}

}  // namespace

bool stops_move_by_themselves(const Settings& settings) { return moved_of(settings).place != nullptr; }

void check_stop_motion(const Settings& settings, const AxisGroups& groups) {
  const Moved moved = moved_of(settings);
  if (moved.place == nullptr) return;
  refuse_others(settings, moved);
  for (const bool is_lower : {true, false}) {
    const Setting* const amplitude = settings.given(amplitudes[is_lower ? 0 : 1]);
    const SourceLocation* const place = place_of_nonzero(amplitude);
    const Parameter stop = is_lower ? Parameter("stop_lower") : Parameter("stop_upper");
    if (place != nullptr && settings.given_symmetric_stops() == nullptr && settings.given(stop) == nullptr)
      fail(*place, in_quotes(amplitude->key->name) + " without that stop; give " + in_quotes(stop.key()));
  }
  check_places(settings, groups, moved);
}

}  // namespace clatter::config

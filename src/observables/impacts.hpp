#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "motion/state.hpp"

namespace clatter::observables {

/// Index of a stop in results: 0 the lower, 1 the upper one.
[[nodiscard]] constexpr std::size_t index_of(Side side) { return side == Side::upper ? 1 : 0; }

/// Counts impacts and sums the time at rest, for each stop.
class Impacts {
 public:
  struct OfStop {
    double count = 0.0;
    double before = std::numeric_limits<double>::quiet_NaN();  ///< velocity before the first impact, signed
    double after = std::numeric_limits<double>::quiet_NaN();   ///< velocity after it
    double rest_time = 0.0;                                    ///< in tau
  };

  template <class A>
  void arc(const A&, double, double length) {
    flown_ = flown_ || length > 0;
  }
  void rest(const motion::Rest& rest) {
    if (rest.held) stops_[index_of(rest.side)].rest_time += rest.length;
  }
  void impact(const motion::Impact& impact) {
    OfStop& stop = stops_[index_of(impact.side)];
    if (stop.count == 0.0) stop.before = impact.before, stop.after = impact.after;
    stop.count += 1.0;
    if (!(first_speed_ >= 0.0)) first_speed_ = impact.before < 0.0 ? -impact.before : impact.before;
  }

  /// Takes over what was counted elsewhere, in motion that isn't at rest throughout.
  void include(const std::array<OfStop, 2>& stops, double first_speed) {
    stops_ = stops, first_speed_ = first_speed, flown_ = true;
  }

  [[nodiscard]] const std::array<OfStop, 2>& stops() const { return stops_; }
  [[nodiscard]] bool flown() const { return flown_; }  ///< whether the mass moves at all, not resting throughout
  [[nodiscard]] double first_speed() const {
    return first_speed_;
  }  ///< |x'| before the first impact on either stop, NaN if none

 private:
  std::array<OfStop, 2> stops_{};
  bool flown_ = false;
  double first_speed_ = std::numeric_limits<double>::quiet_NaN();
};

/// Keeps every impact.
class ImpactLog {
 public:
  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact& impact) { impacts_.push_back(impact); }

  [[nodiscard]] std::vector<motion::Impact>& impacts() { return impacts_; }

 private:
  std::vector<motion::Impact> impacts_;
};

/// Keeps every rest and completed chatter.
class RestLog {
 public:
  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) { rests_.push_back(rest); }
  void impact(const motion::Impact&) {}

  [[nodiscard]] std::vector<motion::Rest>& rests() { return rests_; }

 private:
  std::vector<motion::Rest> rests_;
};

}  // namespace clatter::observables

#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "motion/state.hpp"
#include "observables/impact_log.hpp"

namespace clatter::observables {

class ImpactLog::Observer {
 public:
  Observer() = default;
  Observer(const Settings& settings, const ObservedSpan&) : full_(settings.full_log) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) {
    if (full_) values_.rests.push_back(rest);
  }
  void impact(const motion::Impact& impact) { values_.log.push_back(impact); }
  void impact_at_start(const motion::Impact& at_start) {
    if (full_) impact(at_start);
  }
  /// A contact with a soft stop is logged with the velocities at its beginning and where the stop's force first falls
  /// to 0, NaN if that isn't observed: beyond the stop's position the contact may be renewed after that.
  void touch(const motion::Touch& touch) {
    if (!touch.from_outside) return;
    values_.log.push_back({touch.time, touch.side, touch.velocity, no_value, touch.position});
  }
  void separate(const motion::Separation& separation) {
    if (!values_.log.empty() && values_.log.back().side == separation.side && std::isnan(values_.log.back().after))
      values_.log.back().after = separation.velocity;
  }
  /// The response meets no stop.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] const std::vector<motion::Impact>& impacts() const { return values_.log; }
  [[nodiscard]] Values finish(const ObservedSpan&, double, double) { return std::move(values_); }

 private:
  bool full_ = false;
  Values values_;
};

}  // namespace clatter::observables

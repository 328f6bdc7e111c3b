#pragma once

#include <array>
#include <limits>
#include <utility>

#include "lanes/lane_view.hpp"
#include "stepping/exact.hpp"

namespace clatter::lanes {

/// The scalar loop with the effects of a point in lanes.
template <Effects E>
using ScalarLoop = stepping::Exact<double, E>;

/// Advances a lane in the scalar loop, for motion that the vector code leaves out: chatter, rest and grazes.
template <Effects E>
class ScalarFallback {
 public:
  /// Without observers if not told to observe.
  ScalarFallback(const ScalarLoop<E>& loop, bool observes) : loop_(loop), observes_(observes) {}

  /// By two steps, or to the next section.
  [[nodiscard]] stepping::Outcome advance(LaneView& lane);

  [[nodiscard]] ScalarLoop<E>& loop() { return loop_; }
  [[nodiscard]] const ScalarLoop<E>& loop() const { return loop_; }
  [[nodiscard]] std::int64_t calls() const { return calls_; }
  [[nodiscard]] bool rested() const { return rested_; }  ///< the mass has been at rest
  /// The stop that has held the mass since this was asked last.
  [[nodiscard]] Side take_holding_stop() { return std::exchange(held_by_, Side::none); }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  ScalarLoop<E> loop_;
  bool observes_;
  motion::State<double> end_{};                ///< the state in which the lane was left
  std::array<double, 3> mark_{nan, nan, nan};  ///< the lane's mark then
  std::int64_t calls_ = 0;
  bool rested_ = false;
  Side held_by_ = Side::none;
};

}  // namespace clatter::lanes

#pragma once

#include <array>
#include <utility>

#include "point/rounded.hpp"
#include "steady/rounding_growth.hpp"

namespace clatter::point {

/// Watches how far rounding carries a motion, and which stops release it. E is the set of effects of the run, whose
/// chatter is summed to the accuracy of double: if the mass is then held that is forgotten, else it is an error, too.
template <class Number, Effects E>
class ErrorWatch {
 public:
  explicit ErrorWatch(const Scene& scene)
      : growth_(scene.stops), in_double_(scene), period_(period_of(scene.oscillator)) {}

  template <Effects Of>
  void arc(const motion::Arc<Number, Of>& arc, double begin, double length) {
    if (std::exchange(shows_rest_, false)) return;
    if (held_by_ != Side::none) releases_[index_of(std::exchange(held_by_, Side::none))] = true;
    in_double_.show(arc, [&](const auto& rounded) { growth_.arc(rounded, begin, length); });
  }
  void event(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::rest) held_by_ = event.side;
    shows_rest_ = event.lasts() && event.has_arc && event.length > 0;
    if (event.lasts() && event.held && event.length < shortest_rest) return;
    growth_.event(event);
    if (!event.held) growth_.delay(period_ * epsilon<double>() / static_cast<double>(epsilon<Number>()));
  }

  /// The largest error up to now, relative to the size of the motion.
  [[nodiscard]] double error() const { return growth_.largest() * static_cast<double>(epsilon<Number>()); }

  /// [stop]: whether it has released the mass since this was asked last, or the run has begun.
  [[nodiscard]] std::array<bool, 2> take_releases() { return std::exchange(releases_, {}); }

 private:
  static constexpr double shortest_rest = 1e-9;  // tau; of one that is shorter rounding may decide that it is one

  steady::RoundingGrowth growth_;
  InDouble<E> in_double_;
  double period_;
  Side held_by_ = Side::none;
  bool shows_rest_ = false;  ///< the next arc, of a mass that stays on a stop which moves
  std::array<bool, 2> releases_{};
};

}  // namespace clatter::point

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "motion/arc.hpp"
#include "scene/shaking.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

/// The velocity of a sample that falls on an impact.
enum class AtImpact { after, mean };

/// Displacement and velocity at equally spaced instants of the observed time. Instants within rounding of an impact
/// count as on it.
class Samples {
 public:
  /// `count` instants `spacing` apart, the first one `first` spacings after the beginning of the observed time.
  Samples(std::size_t count, double spacing, AtImpact at_impact, const Stops& stops, double first = 0.0)
      : count_(count),
        spacing_(spacing),
        first_(first),
        rounding_(32 * epsilon<double>() * spacing * static_cast<double>(count)),
        at_impact_(at_impact),
        stops_(rigid_ones(stops)) {
    x_.reserve(count), v_.reserve(count);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    while (is_due_before(begin + length)) add(arc.at(std::max(0.0, due() - begin)));
  }
  /// On an arc in closed form one sample in 64 is evaluated, and those after it follow by steps of 1, 2, ... spacings.
  /// On an arc so short that every digit of it counts, each sample is evaluated. The steps are made anew only if the
  /// arc belongs to another oscillator than the one before, as in contact with a soft stop.
  template <Effects E>
  void arc(const motion::Arc<double, E>& arc, double begin, double length) {
    const std::size_t most = length * arc.constants().rate > 0.25 ? steps_.size() : 0;
    if constexpr (E.stiffness)  // soft stops are among its effects
      if (&arc.constants() != steps_of_) steps_of_ = &arc.constants(), steps_made_ = 0;
    while (is_due_before(begin + length)) {
      const motion::Motion<double> here = arc.at(std::max(0.0, due() - begin));
      add(here);
      const std::size_t more = due_before(begin + length, most);
      for (; steps_made_ < more; ++steps_made_)
        steps_[steps_made_] = arc.constants().step(static_cast<double>(steps_made_ + 1) * spacing_);
      const std::size_t first = x_.size();
      x_.resize(first + more), v_.resize(first + more);
      for (std::size_t i = 0; i < more; ++i) {
        const motion::Motion<double> m = arc.moved(here, steps_[i]);
        x_[first + i] = between_stops(m.x), v_[first + i] = m.v;
      }
      evaluations_ += more;
    }
  }
  void rest(const motion::Rest& rest) {
    while (is_due_before(rest.time + rest.length)) add(rest.position, due() > rest.time ? 0.0 : rest.v_begin);
  }
  void impact(const motion::Impact& impact) {
    last_ = impact;
    while (due() <= impact.time + rounding_ && x_.size() < count_) add(impact.position, at(impact));
  }

  /// Ends the observed time, of length `total`, in a state; in periodic motion an impact at its end is one at its
  /// beginning too.
  void finish(double x, double v, double total, bool periodic) {
    while (x_.size() < count_) add(x, v);
    if (periodic && at_impact_ == AtImpact::mean && last_.time >= total - rounding_) v_.front() = at(last_);
  }

  /// Adds what a frame moves since the beginning of the observed time, once that has ended.
  void add(const FrameMotion& frame) {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const SineCosine<double> theta = frame.at(instant(i));
      x_[i] += frame.displacement(theta), v_[i] += frame.velocity(theta);
    }
  }

  /// The instants since the beginning of the observed time, `end` being the last.
  [[nodiscard]] std::vector<double> times(double end) const {
    std::vector<double> tau(count_);
    for (std::size_t i = 0; i + 1 < count_; ++i) tau[i] = instant(i);
    tau.back() = end;
    return tau;
  }
  [[nodiscard]] bool is_complete() const { return x_.size() == count_; }
  [[nodiscard]] double evaluations() const { return static_cast<double>(evaluations_); }  ///< of arcs
  [[nodiscard]] std::vector<double>& displacement() { return x_; }
  [[nodiscard]] std::vector<double>& velocity() { return v_; }

 private:
  [[nodiscard]] double due() const { return instant(x_.size()); }
  [[nodiscard]] double instant(std::size_t i) const { return (first_ + static_cast<double>(i)) * spacing_; }
  [[nodiscard]] double at(const motion::Impact& impact) const {
    return at_impact_ == AtImpact::after ? impact.after : (impact.before + impact.after) / 2;
  }
  [[nodiscard]] bool is_due_before(double end) const { return due_before(end, 1) == 1; }
  /// The number of the next samples, up to `most`, that lie before an instant.
  [[nodiscard]] std::size_t due_before(double end, std::size_t most) const {
    std::size_t before = x_.size(), behind = before + std::min(most, count_ - before);
    while (before < behind) {
      const std::size_t middle = before + (behind - before) / 2;
      if (instant(middle) < end - rounding_) {
        before = middle + 1;
      } else {
        behind = middle;
      }
    }
    return before - x_.size();
  }
  void add(const motion::Motion<double>& m) { add(m.x, m.v), ++evaluations_; }
  void add(double x, double v) { x_.push_back(between_stops(x)), v_.push_back(v); }
  /// An arc's end may round past; Moreau's time stepping goes past by up to a step.
  [[nodiscard]] double between_stops(double x) const { return std::clamp(x, stops_.lower, stops_.upper); }

  std::size_t count_;
  double spacing_, first_, rounding_;
  AtImpact at_impact_;
  Stops stops_;
  motion::Impact last_{-std::numeric_limits<double>::infinity(), Side::none, 0, 0, 0};
  std::array<motion::Step<double>, 63> steps_;  ///< over 1, 2, ... spacings; as many are made as an arc asks for
  const void* steps_of_ = nullptr;              ///< their oscillator
  std::size_t steps_made_ = 0, evaluations_ = 0;
  std::vector<double> x_, v_;
};

}  // namespace clatter::observables

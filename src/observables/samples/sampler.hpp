#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/state.hpp"
#include "scene/shaking.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

/// The velocity of a sample that falls on an impact.
enum class AtImpact { after, mean };

/// Takes displacement and velocity at equally spaced instants of the observed time. Instants within rounding of an
/// impact count as on it. How the samples of an arc in closed form follow one another is left to those that derive.
class Sampler {
 public:
  template <class A>
  requires(!motion::Housed<A>) void arc(const A& arc, double begin, double length) {
    by_runs(arc, begin, length, 0, [](const auto&, std::size_t) {});
  }
  void event(const motion::Event& event) {
    if (event.lasts() && !event.has_arc)
      while (is_due_before(event.end())) add(event.place, due() > event.time ? 0.0 : event.before);
    if (event.kind != motion::Event::Kind::impact) return;
    last_ = event;
    while (due() <= event.time + rounding_ && !is_complete()) add(event.place, at(event));
  }

  /// Ends the observed time, of length `total`, in a state; in periodic motion an impact at its end is one at its
  /// beginning too.
  void finish(double x, double v, double total, bool periodic) {
    while (!is_complete()) add(x, v);
    if (periodic && at_impact_ == AtImpact::mean && last_.time >= total - rounding_) v_.front() = at(last_);
  }

  /// Adds what a frame moves since the beginning of the observed time, once that has ended.
  void add(const FrameMotion& frame) {
    for (std::size_t i = 0; i < taken_; ++i) {
      const SineCosine<double> theta = frame.at(instant(i));
      x_[i] += frame.displacement(theta), v_[i] += frame.velocity(theta);
    }
  }
  [[nodiscard]] std::size_t count() const { return x_.size(); }
  [[nodiscard]] bool is_complete() const { return taken_ == x_.size(); }
  [[nodiscard]] double evaluations() const { return static_cast<double>(evaluations_); }  ///< of arcs

 protected:
  /// As many samples as the two rows have room for, `spacing` apart, the first one `first` spacings after the beginning
  /// of the observed time.
  Sampler(std::span<double> x, std::span<double> v, double spacing, AtImpact at_impact, const Stops& stops,
          double first)
      : x_(x),
        v_(v),
        spacing_(spacing),
        first_(first),
        rounding_(32 * epsilon<double>() * spacing * static_cast<double>(x.size())),
        at_impact_(at_impact),
        stops_(outermost(rigid_ones(stops))) {}
  Sampler(Sampler&&) = default;  // a copy would write to the same rows
  Sampler& operator=(Sampler&&) = default;
  ~Sampler() = default;

  /// Evaluates an arc at one sample, and lets `follow` take up to `most` that come after it, again and again.
  template <class A, class Follow>
  void by_runs(const A& arc, double begin, double length, std::size_t most, const Follow& follow) {
    while (is_due_before(begin + length)) {
      const motion::Motion<double> here = arc.at(std::max(0.0, due() - begin));
      add(here);
      if (const std::size_t more = due_before(begin + length, most); more > 0) follow(here, more);
    }
  }
  void add(const motion::Motion<double>& m) { add(m.x, m.v), ++evaluations_; }

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] double instant(std::size_t i) const { return (first_ + static_cast<double>(i)) * spacing_; }
  [[nodiscard]] const Stops& stops() const { return stops_; }
  /// The rows from the next sample on.
  [[nodiscard]] std::span<double> next_x() const { return x_.subspan(taken_); }
  [[nodiscard]] std::span<double> next_v() const { return v_.subspan(taken_); }
  [[nodiscard]] std::size_t taken() const { return taken_; }
  /// The next samples have been written.
  void take(std::size_t count) { taken_ += count, evaluations_ += count; }

 private:
  [[nodiscard]] double due() const { return instant(taken_); }
  [[nodiscard]] double at(const motion::Event& impact) const {
    return impact.stop.velocity + (at_impact_ == AtImpact::after ? impact.after : (impact.before + impact.after) / 2);
  }
  [[nodiscard]] bool is_due_before(double end) const { return due_before(end, 1) == 1; }
  /// The number of the next samples, up to `most`, that lie before an instant.
  [[nodiscard]] std::size_t due_before(double end, std::size_t most) const {
    std::size_t before = taken_, behind = before + std::min(most, x_.size() - before);
    while (before < behind) {
      const std::size_t middle = before + (behind - before) / 2;
      if (instant(middle) < end - rounding_) {
        before = middle + 1;
      } else {
        behind = middle;
      }
    }
    return before - taken_;
  }
  /// An arc's end may round past a stop; Moreau's time stepping goes past by up to a step.
  void add(double x, double v) { x_[taken_] = std::clamp(x, stops_.lower, stops_.upper), v_[taken_++] = v; }

  std::span<double> x_, v_;
  double spacing_, first_, rounding_;
  AtImpact at_impact_;
  Stops stops_;
  motion::Event last_{.time = -std::numeric_limits<double>::infinity()};  ///< impact
  std::size_t taken_ = 0, evaluations_ = 0;
};

}  // namespace clatter::observables

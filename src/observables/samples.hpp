#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "dynamics/arc.hpp"
#include "dynamics/stops.hpp"

namespace clatter {

/// What a sample that falls on an impact shows as its velocity.
enum class AtImpact { after, mean };

/// Displacement and velocity at equally spaced instants of the observed time. Instants within rounding of an impact
/// count as on it.
class Samples {
 public:
  /// `count` instants `spacing` apart, from the beginning of the observed time.
  Samples(std::size_t count, double spacing, AtImpact at_impact, const Stops& stops)
      : count_(count),
        spacing_(spacing),
        rounding_(32 * epsilon<double>() * spacing * static_cast<double>(count)),
        at_impact_(at_impact),
        stops_(stops) {
    x_.reserve(count), v_.reserve(count);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    for (; due() < begin + length - rounding_ && x_.size() < count_;) {
      const auto motion = arc.at(std::max(0.0, due() - begin));
      add(motion.x, motion.v);
      ++evaluations_;
    }
  }
  void rest(const Rest& rest) {
    while (due() < rest.time + rest.length - rounding_ && x_.size() < count_) add(rest.place, 0.0);
  }
  void impact(const Impact& impact) {
    last_ = impact;
    while (due() <= impact.time + rounding_ && x_.size() < count_) add(impact.place, at(impact));
  }

  /// Ends the observed time, of length `total`, in a state; in periodic motion an impact at its end is one at its
  /// beginning too.
  void finish(double x, double v, double total, bool periodic) {
    while (x_.size() < count_) add(x, v);
    if (periodic && at_impact_ == AtImpact::mean && last_.time >= total - rounding_) v_.front() = at(last_);
  }

  /// The instants since the beginning of the observed time, `end` being the last.
  [[nodiscard]] std::vector<double> times(double end) const {
    std::vector<double> tau(count_);
    for (std::size_t i = 0; i + 1 < count_; ++i) tau[i] = static_cast<double>(i) * spacing_;
    tau.back() = end;
    return tau;
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs
  [[nodiscard]] std::vector<double>& displacement() { return x_; }
  [[nodiscard]] std::vector<double>& velocity() { return v_; }

 private:
  [[nodiscard]] double due() const { return static_cast<double>(x_.size()) * spacing_; }
  [[nodiscard]] double at(const Impact& impact) const {
    return at_impact_ == AtImpact::after ? impact.after : (impact.before + impact.after) / 2;
  }
  void add(double x, double v) {
    x_.push_back(std::clamp(x, stops_.lower, stops_.upper)), v_.push_back(v);
  }  // an arc's end may round past; Moreau's time stepping goes past by up to a step

  std::size_t count_;
  double spacing_, rounding_;
  AtImpact at_impact_;
  Stops stops_;
  Impact last_{-std::numeric_limits<double>::infinity(), Side::none, 0, 0, 0};
  double evaluations_ = 0.0;
  std::vector<double> x_, v_;
};

}  // namespace clatter

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "motion/arc.hpp"
#include "observables/samples/sampler.hpp"

namespace clatter::observables {

/// Samples in memory of their own.
class Samples : public Sampler {
 public:
  /// `count` instants `spacing` apart, the first one `first` spacings after the beginning of the observed time.
  Samples(std::size_t count, double spacing, AtImpact at_impact, const Stops& stops, double first = 0.0)
      : Samples(std::vector<double>(count), std::vector<double>(count), spacing, at_impact, stops, first) {}

  using Sampler::arc;
  /// On an arc in closed form one sample in 64 is evaluated, and those after it follow by steps of 1, 2, ... spacings.
  /// On an arc so short that every digit of it counts, each sample is evaluated. The steps are made anew only if the
  /// arc belongs to another oscillator than the one before, as in contact with a soft stop.
  template <Effects E>
  void arc(const motion::Arc<double, E>& arc, double begin, double length) {
    const std::size_t most = length * arc.constants().rate > 0.25 ? steps_.size() : 0;
    if constexpr (E.stiffness)  // soft stops are among its effects
      if (&arc.constants() != steps_of_) steps_of_ = &arc.constants(), steps_made_ = 0;
    by_runs(arc, begin, length, most, [&](const motion::Motion<double>& here, std::size_t more) {
      for (; steps_made_ < more; ++steps_made_)
        steps_[steps_made_] = arc.constants().step(static_cast<double>(steps_made_ + 1) * spacing());
      const std::span<double> x = next_x(), v = next_v();
      for (std::size_t i = 0; i < more; ++i) {
        const motion::Motion<double> m = arc.moved(here, steps_[i]);
        x[i] = std::clamp(m.x, stops().lower, stops().upper), v[i] = m.v;
      }
      take(more);
    });
  }

  /// The instants since the beginning of the observed time, `end` being the last.
  [[nodiscard]] std::vector<double> times(double end) const {
    std::vector<double> tau(count());
    for (std::size_t i = 0; i + 1 < tau.size(); ++i) tau[i] = instant(i);
    tau.back() = end;
    return tau;
  }
  /// Those that have been taken: all, once the observed time has ended.
  [[nodiscard]] std::vector<double>& displacement() { return x_.resize(taken()), x_; }
  [[nodiscard]] std::vector<double>& velocity() { return v_.resize(taken()), v_; }

 private:
  Samples(std::vector<double> x, std::vector<double> v, double spacing, AtImpact at_impact, const Stops& stops,
          double first)
      : Sampler(x, v, spacing, at_impact, stops, first), x_(std::move(x)), v_(std::move(v)) {}

  std::vector<double> x_, v_;
  std::array<motion::Step<double>, 63> steps_;  ///< over 1, 2, ... spacings; as many are made as an arc asks for
  const void* steps_of_ = nullptr;              ///< their oscillator
  std::size_t steps_made_ = 0;
};

}  // namespace clatter::observables

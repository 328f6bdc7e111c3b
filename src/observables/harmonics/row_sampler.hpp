#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "motion/arc.hpp"
#include "observables/harmonics/step_row.hpp"
#include "observables/samples/sampler.hpp"

namespace clatter::observables {

/// Samples for a transform, written into its memory. Velocities on impacts are the mean of before and after.
class RowSampler : public Sampler {
 public:
  /// As many samples as the two rows have room for, `spacing` apart, from the beginning of the observed time on.
  RowSampler(std::span<double> x, std::span<double> v, double spacing, const Stops& stops)
      : Sampler(x, v, spacing, AtImpact::mean, stops, 0.0) {}

  using Sampler::arc;
  /// On an arc in closed form one sample in 257 is evaluated. Those after it follow in rows, from instants to which
  /// steps of whole rows lead, so that no error grows along an arc. On an arc so short that every digit of it counts,
  /// or under a force of several sines, each sample is evaluated.
  template <Effects E>
  void arc(const motion::Arc<double, E>& arc, double begin, double length) {
    if constexpr (E.stiffness)  // soft stops are among its effects
      if (&arc.constants() != steps_of_) forget_steps(&arc.constants());
    const bool each = length * arc.constants().rate <= 0.25 || arc.constants().has_orders();
    by_runs(arc, begin, length, each ? 0 : rows * StepRow::size, [&](const auto& here, std::size_t more) {
      take_row(arc, here, std::min(more, StepRow::size));
      for (std::size_t row = 1; row * StepRow::size < more; ++row)
        take_row(arc, arc.moved(here, step_over(row, arc.constants())),
                 std::min(more - row * StepRow::size, StepRow::size));
    });
  }

 private:
  static constexpr std::size_t rows = 16;  ///< between evaluations

  void forget_steps(const void* oscillator) { steps_of_ = oscillator, rows_made_ = 1, steps_.clear(); }
  template <class Constants>
  const motion::Step<double>& step_over(std::size_t row, const Constants& constants) {
    for (; rows_made_ <= row; ++rows_made_)
      over_rows_[rows_made_] = constants.step(static_cast<double>(rows_made_ * StepRow::size) * spacing());
    return over_rows_[row];
  }
  /// Takes the samples after an instant of an arc, up to a row of them.
  template <Effects E>
  void take_row(const motion::Arc<double, E>& arc, const motion::Motion<double>& from, std::size_t count) {
    steps_.make(arc.constants(), count, spacing());
    const std::span<double> x = next_x(), v = next_v();
    if (x.size() >= StepRow::size) {  // what is beyond `count` will be written again
      steps_.take(from, arc.anchor(), stops(), x.data(), v.data());
    } else {
      std::array<double, StepRow::size> last_x, last_v;
      steps_.take(from, arc.anchor(), stops(), last_x.data(), last_v.data());
      std::copy_n(last_x.begin(), count, x.begin()), std::copy_n(last_v.begin(), count, v.begin());
    }
    take(count);
  }

  StepRow steps_;
  std::array<motion::Step<double>, rows> over_rows_;  ///< over 1, 2, ... rows, the first unused
  std::size_t rows_made_ = 1;
  const void* steps_of_ = nullptr;  ///< the oscillator of the steps
};

}  // namespace clatter::observables

#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "observables/harmonics/exact_harmonics.hpp"
#include "observables/harmonics/harmonics.hpp"
#include "observables/harmonics/row_sampler.hpp"
#include "observables/samples/housing_samples.hpp"

namespace clatter::observables {

class Harmonics::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span) : highest_(count_of(settings) - 1) {
    const bool is_loose = settings.loose_harmonics && has_loose_mass(span.scene.loose);
    if (from_samples(settings)) {
      const auto [x, v] = span.fourier->transform->samples(*span.fourier->workspace);
      const double spacing = span.total / static_cast<double>(x.size());
      samples_.emplace(x, v, spacing, span.scene.stops);
      if (is_loose) loose_samples_.emplace(x.size(), spacing, AtImpact::mean, span.scene.loose);
    } else {
      exact_.emplace(highest_, span.base_frequency);
      if (is_loose) loose_exact_.emplace(std::in_place, highest_, span.base_frequency);
    }
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    by([&](auto& observer) { observer.arc(motion::main_of(arc), begin, length); });
    if constexpr (motion::Housed<A>) by_loose([&](auto& observer) { observer.arc(arc, begin, length); });
  }
  /// Of a loose mass, the impact of the main one, too.
  void event(const motion::Event& event) {
    by([&](auto& observer) { observer.event(event.of_main()); });
    by_loose([&](auto& observer) { observer.event(event); });
  }
  /// Exact harmonics know the response; those of its samples are the same, since a sine over whole periods has one sum
  /// alone that isn't 0.
  bool response(const ObservedSpan& span, double x) {
    if (samples_) exact_.emplace(highest_, span.base_frequency);
    exact_->response(span.scene.oscillator, span.scene.start.phase, x, span.total);
    return true;
  }
  /// Of the exact method: takes over all flights at once, as `ExactHarmonics::flights`.
  void flights(const ObservedSpan& span, const PhasePoint& first, const PhasePoint& last,
               std::span<const std::complex<double>> jumps) {
    exact_->flights(span.scene.oscillator, span.scene.start.phase, first, last, span.total, jumps);
  }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v);
  [[nodiscard]] double evaluations() const {  ///< of arcs
    const double of_loose = loose_exact_     ? loose_exact_->of().evaluations()
                            : loose_samples_ ? loose_samples_->of().evaluations()
                                             : 0.0;
    return (exact_ ? exact_->evaluations() : samples_->evaluations()) + of_loose;
  }

 private:
  template <class Function>
  void by(Function&& function) {
    if (exact_) return function(*exact_);
    function(*samples_);
  }
  template <class Function>
  void by_loose(Function&& function) {
    if (loose_exact_) function(*loose_exact_);
    if (loose_samples_) function(*loose_samples_);
  }

  [[nodiscard]] Values finish_exact(const ObservedSpan& span, double x);
  [[nodiscard]] Values finish_samples(const ObservedSpan& span, double x, double v);

  std::size_t highest_;
  std::optional<RowSampler> samples_;                     ///< none by the exact method
  std::optional<ExactHarmonics> exact_;                   ///< by the exact method, and of the response
  std::optional<HousingSamples> loose_samples_;           ///< of a loose mass
  std::optional<InHousing<ExactHarmonics>> loose_exact_;  ///< of a loose mass
};

}  // namespace clatter::observables

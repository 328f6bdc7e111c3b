#pragma once

#include <optional>
#include <utility>

#include "observables/samples/housing_samples.hpp"
#include "observables/samples/samples.hpp"
#include "observables/samples/trajectory.hpp"

namespace clatter::observables {

class Trajectory::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : samples_(count_of(settings), span.total / static_cast<double>(settings.trajectory - 1), AtImpact::after,
                 span.scene.stops) {
    if (has_loose_mass(span.scene.loose))
      loose_.emplace(count_of(settings), span.total / static_cast<double>(settings.trajectory - 1), AtImpact::after,
                     span.scene.loose);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    samples_.arc(motion::main_of(arc), begin, length);
    if constexpr (motion::Housed<A>) loose_->arc(arc, begin, length);
  }
  void event(const motion::Event& event) {
    samples_.event(event.of_main());
    if (loose_) loose_->event(event);
  }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    samples_.finish(x, v, span.total, span.periodic);
    if (span.frame) samples_.add(*span.frame);
    Values values{samples_.times(span.total), std::move(samples_.displacement()), std::move(samples_.velocity())};
    if (loose_) {
      loose_->finish(span.total, span.periodic);
      values.z = std::move(loose_->place()), values.w = std::move(loose_->velocity());
    }
    return values;
  }
  [[nodiscard]] double evaluations() const { return samples_.evaluations(); }  ///< of arcs

 private:
  Samples samples_;
  std::optional<HousingSamples> loose_{};  ///< of a loose mass
};

}  // namespace clatter::observables

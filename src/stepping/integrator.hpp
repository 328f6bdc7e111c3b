#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "motion/event.hpp"
#include "stepping/integration.hpp"
#include "stepping/main_mass.hpp"

namespace clatter::stepping {

/// An observer that records nothing.
struct NoObserver {
  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event&) {}
};

/// The parts common to all integrators: the main mass, the clock, the work spent so far, and its limits.
template <class N, Effects E>
class IntegratorBase : public MainMass<N, E> {
 public:
  using Number = N;

  /// Looks for contacts with the stops in reach only.
  IntegratorBase(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits)
      : MainMass<N, E>(motion::ArcConstants<Number, E.arc()>(scene.oscillator), in_reach, scene.friction,
                       turns_of(Number(scene.start.phase))),
        budget_(limits.impacts),
        longest_(limits.periods) {}

  /// Called with the share of its limits that a run has spent, several times a second in a long run.
  using Listener = std::function<void(double share)>;

  /// Reports progress to a listener; null: to none.
  void report_to(const Listener* listener) {
    listener_ = listener != nullptr && *listener ? listener : nullptr;
    next_report_ = listener_ != nullptr ? evaluations_ + between_reports : infinity;
  }

  [[nodiscard]] double impacts() const { return impacts_; }          ///< impacts simulated so far
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs; of the equation by general methods

  /// Time since the stroboscopic section `origin`.
  [[nodiscard]] double time(const motion::State<Number>& state, std::int64_t origin) const {
    return static_cast<double>((static_cast<double>(state.periods - origin) + state.phase_turns) * this->period());
  }

  // For the modes.

  [[nodiscard]] static bool finite(const Number& x) { return std::isfinite(static_cast<double>(x)); }
  [[nodiscard]] static Outcome outcome_of(const motion::State<Number>& state) {
    return finite(state.x) && finite(state.v) ? Outcome::completed : Outcome::not_finite;
  }

  /// Counts an impact; false if the budget is exceeded.
  [[nodiscard]] bool count_impact() { return ++impacts_ <= budget_; }
  void count_evaluations(double count) { evaluations_ += count; }
  void report(const motion::State<Number>& state) {
    if (evaluations_ < next_report_) [[likely]]
      return;
    const double turns = static_cast<double>(state.periods) + static_cast<double>(state.phase_turns);
    (*listener_)(std::min(1.0, std::max(impacts_ / budget_, turns / longest_)));
    next_report_ = evaluations_ + between_reports;
  }

 private:
  static constexpr double between_reports = 1 << 18;  ///< evaluations: about a tenth of a second
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double budget_;
  double longest_;  ///< forcing periods that a run may take
  double impacts_ = 0.0;
  double evaluations_ = 0.0;
  const Listener* listener_ = nullptr;
  double next_report_ = infinity;  ///< evaluations
};

/// Advances a state to a phase and reports arcs and events on the way to an observer. Observers don't depend on
/// the integrator, nor integrators on the observables.
template <class I>
concept Integrator = requires(I& integrator, motion::State<typename I::Number>& state, const typename I::Number& end,
                              NoObserver& observer) {
  { integrator.advance(state, end, std::int64_t{}, observer) } -> std::same_as<Outcome>;
  { integrator.holding_stop(state) } -> std::same_as<std::optional<motion::Stop<typename I::Number>>>;
  { I::in_closed_form } -> std::convertible_to<bool>;  ///< its arcs are exact, so shortcuts may use them
  requires std::derived_from<I, IntegratorBase<typename I::Number, I::effects>>;
};

}  // namespace clatter::stepping

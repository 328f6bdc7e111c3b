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

#include "motion/contact_force.hpp"
#include "motion/dry_friction.hpp"
#include "motion/event.hpp"
#include "scene/scene.hpp"
#include "stepping/integration.hpp"

namespace clatter::stepping {

/// An observer that records nothing.
struct NoObserver {
  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event&) {}
};

/// The parts common to all integrators: the scene's constants and clock, the work spent so far, and its limits.
template <class N, Effects E>
class IntegratorBase {
 public:
  using Number = N;
  static constexpr Effects effects = E;

  /// Looks for contacts with the stops in reach only.
  IntegratorBase(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits)
      : constants_(scene.oscillator),
        stops_(in_reach),
        soft_(constants_, stops_),
        slips_(constants_, scene.friction, stops_),
        budget_(limits.impacts),
        longest_(limits.periods),
        start_turns_(turns_of(Number(scene.start.phase))) {}

  /// Called with the share of its limits that a run has spent, several times a second in a long run.
  using Listener = std::function<void(double share)>;

  /// Reports progress to a listener; null: to none.
  void report_to(const Listener* listener) {
    listener_ = listener != nullptr && *listener ? listener : nullptr;
    next_report_ = listener_ != nullptr ? evaluations_ + between_reports : infinity;
  }

  [[nodiscard]] const motion::ArcConstants<Number, E.arc()>& constants() const { return constants_; }
  [[nodiscard]] const BasicStops<Number>& stops() const { return stops_; }  ///< the stops in reach
  /// Forcing period in tau; without forcing 2 pi.
  [[nodiscard]] const Number& period() const { return constants_.period; }
  [[nodiscard]] double impacts() const { return impacts_; }          ///< impacts simulated so far
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs; of the equation by general methods

  /// The stop that holds a mass at rest, if one does.
  [[nodiscard]] std::optional<motion::Stop<Number>> holding_stop(const motion::State<Number>& state) const {
    if (!E.rest || state.v != 0 || state.released) return std::nullopt;
    if constexpr (E.friction)
      if (is_rough()) {
        const auto holding = held(state);
        if (!holding || holding->stop == Side::none) return std::nullopt;
        return motion::stop_at<Number>(stops_, holding->stop);
      }
    for (const Side side : {Side::lower, Side::upper}) {
      if (E.soft && is_soft(stops_, side)) continue;
      const auto stop = motion::stop_at<Number>(stops_, side);
      if (state.x == stop.position && holds(constants_, stop, phase(state))) return stop;
    }
    return std::nullopt;
  }

  /// Whether there is dry friction.
  [[nodiscard]] bool is_rough() const { return slips_.is_rough(); }
  /// The static level of the friction.
  [[nodiscard]] Number static_level() const requires(E.friction) { return slips_.static_level; }
  /// The friction, and the stop if there is one, that holds a mass at x' = 0; nothing: it moves on.
  [[nodiscard]] std::optional<motion::Holding<Number>> held(const motion::State<Number>& state) const
      requires(E.friction) {
    if (state.v != 0 || state.released) return std::nullopt;
    const motion::Holding<Number> holding = holding_at(state);
    return holding.holds(constants_, phase(state)) ? std::optional(holding) : std::nullopt;
  }
  /// Whether friction holds a mass for good, away from rigid stops.
  [[nodiscard]] bool sticks_for_good(const motion::State<Number>& state) const {
    if constexpr (E.friction) {
      if (!is_rough()) return false;
      const auto holding = held(state);
      return holding && holding->stop == Side::none && !holding->release_phase(constants_, Side::lower) &&
             !holding->release_phase(constants_, Side::upper);
    }
    return false;
  }

  /// Calls `function(constants)` with those of motion in contact with a soft stop.
  template <class Function>
  decltype(auto) in_contact(Side side, Function&& function) const {
    return soft_.with_constants(side, std::forward<Function>(function));
  }

  /// The forcing phase.
  [[nodiscard]] SineCosine<Number> phase(const motion::State<Number>& state) const {
    return sine_cosine_of_turns(Number(start_turns_ + state.phase_turns));
  }

  /// Time since the stroboscopic section `origin`.
  [[nodiscard]] double time(const motion::State<Number>& state, std::int64_t origin) const {
    return static_cast<double>((static_cast<double>(state.periods - origin) + state.phase_turns) * constants_.period);
  }

  // For the modes.

  /// What may hold a mass at x' = 0: the constant forces there, those of a soft stop included, and the static level.
  [[nodiscard]] motion::Holding<Number> holding_at(const motion::State<Number>& state) const requires(E.friction) {
    motion::Holding<Number> holding{Side::none, constants_.constant_force(state.x), slips_.static_level};
    for (const Side side : {Side::lower, Side::upper}) {
      const auto stop = motion::stop_at<Number>(stops_, side);
      const bool just_off = state.from_stop == side && state.offset != 0;  // by less than x can tell
      if (!is_soft(stops_, side) && state.x == stop.position && !just_off) holding.stop = side;
    }
    Side within = state.within;
    Number depth = state.offset;
    if (within == Side::none) {
      const auto around = motion::soft_stop_around(stops_, state.x, state.v);
      within = around.side, depth = around.offset;
    }
    if (within != Side::none) holding.constant -= motion::soft_stop_at<Number>(stops_, within).stiffness * depth;
    return holding;
  }
  [[nodiscard]] const auto& slips() const { return slips_; }
  [[nodiscard]] static bool finite(const Number& x) { return std::isfinite(static_cast<double>(x)); }
  [[nodiscard]] static Outcome outcome_of(const motion::State<Number>& state) {
    return finite(state.x) && finite(state.v) ? Outcome::completed : Outcome::not_finite;
  }
  [[nodiscard]] const Number& start_turns() const { return start_turns_; }  ///< forcing phase at tau = 0

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

  motion::ArcConstants<Number, E.arc()> constants_;
  BasicStops<Number> stops_;
  [[no_unique_address]] std::conditional_t<E.soft, motion::SoftContact<Number>, motion::NoSoftContact> soft_;
  [[no_unique_address]] std::conditional_t<E.friction, motion::Slips<Number, E.arc()>, motion::NoSlips> slips_;
  double budget_;
  double longest_;  ///< forcing periods that a run may take
  Number start_turns_;
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

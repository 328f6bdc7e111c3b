#pragma once

#include <concepts>
#include <optional>
#include <tuple>
#include <type_traits>

#include "motion/state.hpp"
#include "observables/all.hpp"
#include "observables/energy_observer.hpp"
#include "observables/extrema_observer.hpp"
#include "observables/harmonics_observer.hpp"
#include "observables/impact_log_observer.hpp"
#include "observables/impact_word_observer.hpp"
#include "observables/impacts_observer.hpp"
#include "observables/observable_list.hpp"
#include "observables/period_observer.hpp"
#include "observables/section_observer.hpp"
#include "observables/sensitivity_observer.hpp"
#include "observables/stability_observer.hpp"
#include "observables/trajectory_observer.hpp"

namespace clatter::observables {

/// The observer of an observable: it begins with the observed time, sees arcs, rests and impacts, and gives the values
/// at the end.
template <class O>
concept Observed = Observable<O> &&
    requires(const typename O::Settings& settings, typename O::Observer& observer, const ObservedSpan& span,
             const motion::Rest& rest, const motion::Impact& impact) {
  requires std::constructible_from<typename O::Observer, const typename O::Settings&, const ObservedSpan&>;
  observer.rest(rest);
  observer.impact(impact);
  { observer.finish(span, 0.0, 0.0) } -> std::same_as<typename O::Values>;
};

/// The observers of a list that are asked for. Each is called once an arc, and costs nothing if it is absent.
template <class List>
class Observers;

template <Observed... Os>
class Observers<ObservableList<Os...>> {
 public:
  using List = ObservableList<Os...>;

  Observers(const typename List::Settings& settings, const ObservedSpan& span) {
    each([&]<class O>(Slot<O>& slot) {
      if (O::wanted(settings)) slot.observer.emplace(settings, span);
    });
  }

  /// The observer of an observable; empty if it isn't asked for.
  template <class O>
  [[nodiscard]] std::optional<typename O::Observer>& of() {
    return std::get<Slot<O>>(slots_).observer;
  }

  /// Takes the observed time of the steady response to the force, whole periods that no stop interrupts, from
  /// displacement x on, by its amplitude and phase; for observers that can't, it still has to be run.
  void response(const ObservedSpan& span, double x) {
    is_response_ = true;
    each([&]<class O>(Slot<O>& slot) {
      if constexpr (requires { slot.observer->response(span, x); })
        slot.is_known = slot.observer && slot.observer->response(span, x);
    });
  }
  /// Whether anything still has to see the flights.
  [[nodiscard]] bool need_flights() const {
    return !is_response_ || ((std::get<Slot<Os>>(slots_).observer && !std::get<Slot<Os>>(slots_).is_known) || ...);
  }

  /// Shows what follows to one observer alone.
  template <class O>
  void go_on_with() {
    each([]<class Other>(Slot<Other>& slot) { slot.is_known = !std::is_same_v<O, Other>; });
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    present([&](auto& observer) { observer.arc(arc, begin, length); });
  }
  void rest(const motion::Rest& rest) {
    present([&](auto& observer) { observer.rest(rest); });
  }
  /// An impact at the very beginning belongs to the time before, and is shown to those alone that ask for it.
  void impact(const motion::Impact& impact) {
    present([&](auto& observer) {
      if (impact.time > 0.0) {
        observer.impact(impact);
      } else if constexpr (requires { observer.impact_at_start(impact); }) {
        observer.impact_at_start(impact);
      }
    });
  }

  /// The beginning of a contact with a soft stop, and its end, for those that ask for them; one at the very beginning
  /// belongs to the time before, like an impact.
  void touch(const motion::Touch& touch) {
    if (!(touch.time > 0.0)) return;
    present([&](auto& observer) {
      if constexpr (requires { observer.touch(touch); }) observer.touch(touch);
    });
  }
  void separate(const motion::Separation& separation) {
    if (!(separation.time > 0.0)) return;
    present([&](auto& observer) {
      if constexpr (requires { observer.separate(separation); }) observer.separate(separation);
    });
  }

  /// A loose mass in its housing, for those that ask for it: its flight while the main mass moves along an arc that has
  /// just been shown, its impacts on walls, and the times in which a wall presses it, along such an arc, too. An impact
  /// at the very beginning belongs to the time before.
  template <class A>
  void in_housing(const A& arc, double begin, double length) {
    present([&](auto& observer) {
      if constexpr (requires { observer.in_housing(arc, begin, length); }) observer.in_housing(arc, begin, length);
    });
  }
  void strike(const motion::Strike& strike) {
    present([&](auto& observer) {
      if (strike.time > 0.0) {
        if constexpr (requires { observer.strike(strike); }) observer.strike(strike);
      } else if constexpr (requires { observer.strike_at_start(strike); }) {
        observer.strike_at_start(strike);
      }
    });
  }
  void press(const motion::Press& press) {
    present([&](auto& observer) {
      if constexpr (requires { observer.press(press); }) observer.press(press);
    });
  }
  template <class A>
  void hold(const A& arc, const motion::Rest& hold) {
    present([&](auto& observer) {
      if constexpr (requires { observer.hold(arc, hold); }) observer.hold(arc, hold);
    });
  }

  /// The velocity of a slip passes 0, for those that ask for it.
  void reversal(const motion::Reversal& reversal) {
    present([&](auto& observer) {
      if constexpr (requires { observer.reversal(reversal); }) observer.reversal(reversal);
    });
  }

  /// Ends the observed time in a state, and fills in the values of every observer.
  void finish(const ObservedSpan& span, double x, double v, typename List::Values& values) {
    each([&]<class O>(Slot<O>& slot) {
      if (slot.observer) static_cast<typename O::Values&>(values) = slot.observer->finish(span, x, v);
    });
  }

  /// Of arcs, by all observers together.
  [[nodiscard]] double evaluations() const {
    const auto of = [](const auto& slot) {
      if constexpr (requires { slot.observer->evaluations(); })
        return slot.observer ? slot.observer->evaluations() : 0.0;
      return 0.0;
    };
    return (of(std::get<Slot<Os>>(slots_)) + ...);
  }

 private:
  template <class O>
  struct Slot {
    std::optional<typename O::Observer> observer;
    bool is_known = false;  ///< without the flights, or without those that follow

    Slot() {}  // not defaulted: the tuple would first clear the kilobytes that an absent observer could take
  };

  template <class Function>
  void each(Function&& function) {
    (function.template operator()<Os>(std::get<Slot<Os>>(slots_)), ...);
  }
  template <class Function>
  void present(Function&& function) {
    each([&]<class O>(Slot<O>& slot) {
      if (slot.observer && !slot.is_known) function(*slot.observer);
    });
  }

  std::tuple<Slot<Os>...> slots_;
  bool is_response_ = false;
};

}  // namespace clatter::observables

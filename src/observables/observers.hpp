#pragma once

#include <concepts>
#include <optional>
#include <tuple>
#include <type_traits>

#include "motion/event.hpp"
#include "observables/all.hpp"
#include "observables/contacts/impact_log_observer.hpp"
#include "observables/contacts/impact_word_observer.hpp"
#include "observables/contacts/impacts_observer.hpp"
#include "observables/energy/energy_observer.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/harmonics_observer.hpp"
#include "observables/observable_list.hpp"
#include "observables/period_observer.hpp"
#include "observables/samples/section_observer.hpp"
#include "observables/samples/trajectory_observer.hpp"
#include "observables/sensitivity/sensitivity_observer.hpp"
#include "observables/stability/stability_observer.hpp"

namespace clatter::observables {

/// The observer of an observable: it begins with the observed time, sees arcs and events, and gives the values at the
/// end.
template <class O>
concept Observed = Observable<O> && requires(const typename O::Settings& settings, typename O::Observer& observer,
                                             const ObservedSpan& span, const motion::Event& event) {
  requires std::constructible_from<typename O::Observer, const typename O::Settings&, const ObservedSpan&>;
  observer.event(event);
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
  /// A contact that begins or ends at the very beginning belongs to the time before, and is shown to those alone that
  /// ask for it.
  void event(const motion::Event& event) {
    const bool is_of_before = event.is_contact() && !(event.time > 0.0);
    present([&](auto& observer) {
      if (!is_of_before) {
        observer.event(event);
      } else if constexpr (requires { observer.event_at_start(event); }) {
        observer.event_at_start(event);
      }
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

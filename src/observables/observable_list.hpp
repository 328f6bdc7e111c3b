#pragma once

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// All that there is about an observable: its settings and their keys, its values and the columns that they fill, and
/// an observer, which begins with the observed time, sees arcs, rests and impacts, and gives its values at the end.
template <class O>
concept Observable = requires(const typename O::Settings& settings, O& observer, const ObservedSpan& span,
                              const motion::Rest& rest, const motion::Impact& impact) {
  O::fields;
  { O::wanted(settings) } -> std::same_as<bool>;
  { O::description(settings) } -> std::same_as<std::string>;
  { O::columns(settings) } -> std::same_as<std::vector<Column<typename O::Values>>>;
  O(settings, span);
  observer.rest(rest);
  observer.impact(impact);
  { observer.finish(span, 0.0, 0.0) } -> std::same_as<typename O::Values>;
};

namespace detail {

template <class O>
bool lanes_observe(const typename O::Settings& settings, const ObservedSpan& span) {
  if constexpr (requires { O::in_lanes(settings, span); }) return O::in_lanes(settings, span);
  return false;
}

template <class O>
double values_held(const typename O::Settings& settings) {
  if constexpr (requires { O::values_held(settings); }) return O::wanted(settings) ? O::values_held(settings) : 0.0;
  return 0.0;
}

}  // namespace detail

/// Observables side by side; the settings and values of a point are those of each together.
template <Observable... Os>
struct ObservableList {
  struct Settings : Os::Settings... {};
  struct Values : Os::Values... {};

  /// Calls `function.operator()<O>()` for each observable.
  template <class Function>
  static void each(Function&& function) {
    (function.template operator()<Os>(), ...);
  }

  /// The keys, in the order of the list.
  [[nodiscard]] static std::vector<Key> keys() {
    std::vector<Key> all;
    each([&]<class O>() { std::apply([&](const auto&... field) { (all.push_back(field.key), ...); }, O::fields); });
    return all;
  }

  /// The observables that are asked for, e.g. "harmonics 0 ... 3 by FFT of 4096 samples".
  [[nodiscard]] static std::vector<std::string> descriptions(const Settings& settings) {
    std::vector<std::string> all;
    each([&]<class O>() {
      if (O::wanted(settings)) all.push_back(O::description(settings));
    });
    return all;
  }

  /// The columns of those asked for, filled from any type that has their values, in the order of the list.
  template <std::derived_from<Values> Result>
  [[nodiscard]] static std::vector<Column<Result>> columns(const Settings& settings) {
    std::vector<Column<Result>> all;
    each([&]<class O>() {
      if (!O::wanted(settings)) return;
      for (Column<typename O::Values>& c : O::columns(settings))
        all.push_back({std::move(c.name), std::move(c.long_name), c.quantity, std::move(c.along), std::move(c.put),
                       std::move(c.text), c.longest_text, c.intermediate, std::move(c.name_in_si), c.frame});
    });
    return all;
  }

  /// The names of all columns of texts.
  [[nodiscard]] static std::vector<std::string> names_of_texts() {
    std::vector<std::string> names;
    each([&]<class O>() {
      for (const Column<typename O::Values>& column : O::columns(typename O::Settings{}))
        if (column.text) names.push_back(column.name);
    });
    return names;
  }

  /// The dimensions that they add, each once.
  [[nodiscard]] static std::vector<Coordinate> coordinates(const Settings& settings) {
    std::vector<Coordinate> all;
    for (Column<Values>& column : columns<Values>(settings))
      for (Coordinate& coordinate : column.along)
        if (std::ranges::find(all, coordinate.name, &Coordinate::name) == all.end())
          all.push_back(std::move(coordinate));
    return all;
  }

  /// Numbers that the observers of a point hold meanwhile, at most.
  [[nodiscard]] static double values_held(const Settings& settings) {
    return (detail::values_held<Os>(settings) + ...);
  }

  /// Whether SIMD lanes can observe all that is asked for, over a span whose turns and kind are known.
  [[nodiscard]] static bool in_lanes(const Settings& settings, const ObservedSpan& span) {
    return ((!Os::wanted(settings) || detail::lanes_observe<Os>(settings, span)) && ...);
  }
};

/// The observers of a list that are asked for. Each is called once an arc, and costs nothing if it is absent.
template <class List>
class Observers;

template <class... Os>
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
  [[nodiscard]] std::optional<O>& of() {
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
    std::optional<O> observer;
    bool is_known = false;  ///< without the flights

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

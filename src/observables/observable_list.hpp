#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// All that is known of an observable but for its observer: its settings and their keys, its values and the columns
/// that they fill.
template <class O>
concept Observable = requires(const typename O::Settings& settings) {
  O::fields;
  { O::wanted(settings) } -> std::same_as<bool>;
  { O::description(settings) } -> std::same_as<std::string>;
  { O::columns(settings) } -> std::same_as<std::vector<Column<typename O::Values>>>;
};

namespace detail {

template <class O>
bool lanes_observe(const typename O::Settings& settings, const ObservedSpan& span) {
  if constexpr (requires { O::in_lanes(settings, span); }) return O::in_lanes(settings, span);
  return false;
}

template <class O>
double values_held(const typename O::Settings& settings, int points) {
  if constexpr (requires { O::values_held(settings, points); })
    return O::wanted(settings) ? O::values_held(settings, points) : 0.0;
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
                       std::move(c.text), c.longest_text, c.intermediate, std::move(c.name_in_si),
                       std::get<0>(O::fields).key.name, c.frame, c.missing_if, c.per});
    });
    return all;
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

  /// Numbers that the observers of so many points hold meanwhile, at most.
  [[nodiscard]] static double values_held(const Settings& settings, int points) {
    return (detail::values_held<Os>(settings, points) + ...);
  }

  /// Whether SIMD lanes can observe all that is asked for, over a span whose turns and kind are known.
  [[nodiscard]] static bool in_lanes(const Settings& settings, const ObservedSpan& span) {
    return ((!Os::wanted(settings) || detail::lanes_observe<Os>(settings, span)) && ...);
  }
};

}  // namespace clatter::observables

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "observables/harmonics/fourier_transform.hpp"
#include "scene/given_scene.hpp"
#include "scene/key.hpp"
#include "scene/quantity.hpp"
#include "scene/scene.hpp"
#include "scene/shaking.hpp"

namespace clatter::observables {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A key of [observe] and the field that it sets: a bool, an integer, a number, or an enumeration in the order of the
/// key's choices.
template <class Settings, class T>
struct Field {
  Key key;
  T Settings::*member;
};
template <class Settings, class T>
Field(Key, T Settings::*) -> Field<Settings, T>;  // clang++ 14 doesn't deduce aggregates by itself

/// A dimension of the results beyond the axes of a sweep, and its coordinate, if it has one.
struct Coordinate {
  std::string name;
  std::size_t length = 0;
  std::variant<std::monostate, std::vector<std::int64_t>, std::vector<std::int8_t>> values{};  ///< shape [length]
  std::string long_name{};
};

/// Results over the two stops.
[[nodiscard]] inline Coordinate stop_coordinate() {
  return {"stop", 2, std::vector<std::int8_t>{-1, 1}, "-1: lower stop, +1: upper stop"};
}

/// The frame of a column in a scene that is shaken.
enum class FrameOf : std::uint8_t {
  any,       ///< the values are the same in both
  relative,  ///< always that of what is shaken
  absolute,  ///< always that of the ground
  observed   ///< the one that is asked for
};

/// A variable of the results, and how to extract it from the values of a point.
template <class Values>
struct Column {
  std::string name, long_name;
  Quantity quantity = Quantity::number;
  std::vector<Coordinate> along;                           ///< dimensions beyond the sweep's axes, at most one
  std::function<void(const Values&, double* values)> put;  ///< writes `width()` values
  std::function<std::string(const Values&)> text{};        ///< instead of numbers: a text in UTF-8
  std::size_t longest_text = 0;                            ///< bytes
  bool intermediate = false;      ///< a number for later work on the whole sweep: in journals and shards only
  std::string name_in_si{};       ///< the long name in the results of a machine, if that is another
  std::string_view observable{};  ///< the key of [observe] that asks for it
  FrameOf frame = FrameOf::any;
  std::string_view missing_if{};    ///< when a point that hasn't failed has no value, NaN or an empty text, in words
  Quantity per = Quantity::number;  ///< of a derivative: the quantity of what it is by, in the user's units

  [[nodiscard]] std::size_t width() const { return along.empty() ? 1 : along.front().length; }
};

template <class Values>
[[nodiscard]] Column<Values> scalar(std::string name, std::string long_name, double Values::*member,
                                    Quantity quantity = Quantity::number) {
  return {std::move(name), std::move(long_name), quantity, {}, [member](const Values& v, double* out) {
            *out = v.*member;
          }};
}

template <class Values>
[[nodiscard]] Column<Values> text(std::string name, std::string long_name, std::string Values::*member,
                                  std::size_t longest) {
  return {
      std::move(name), std::move(long_name), Quantity::number, {}, {}, [member](const Values& v) { return v.*member; },
      longest};
}

/// Two values, over `stop` or another coordinate of that length.
template <class Values>
[[nodiscard]] Column<Values> pair(std::string name, std::string long_name, Coordinate along,
                                  std::array<double, 2> Values::*member, Quantity quantity = Quantity::number) {
  const auto put = [member](const Values& v, double* out) { std::ranges::copy(v.*member, out); };
  return {std::move(name), std::move(long_name), quantity, {std::move(along)}, put};
}

/// The values of a vector, NaN beyond its end; `get` gives the vector.
template <class Values, class Get>
[[nodiscard]] Column<Values> series(std::string name, std::string long_name, Quantity quantity, Coordinate along,
                                    Get get) {
  const auto put = [width = along.length, get](const Values& v, double* out) {
    const std::vector<double>& values = get(v);
    const std::size_t present = std::min(width, values.size());
    std::fill_n(std::copy_n(values.begin(), present, out), width - present, no_value);
  };
  return {std::move(name), std::move(long_name), quantity, {std::move(along)}, put};
}

/// A column whose long name is another one in the results of a machine.
template <class Values>
[[nodiscard]] Column<Values> in_si(std::string_view long_name, Column<Values> column) {
  column.name_in_si = long_name;
  return column;
}

/// A column that is given in the frame that is asked for.
template <class Values>
[[nodiscard]] Column<Values> in_observed_frame(Column<Values> column) {
  column.frame = FrameOf::observed;
  return column;
}

/// A column that is always relative to what is shaken.
template <class Values>
[[nodiscard]] Column<Values> in_relative_frame(Column<Values> column) {
  column.frame = FrameOf::relative;
  return column;
}

/// A column that lacks its value, which is then NaN or an empty text, if these words hold: "the stop isn't hit".
template <class Values>
[[nodiscard]] Column<Values> missing_if(std::string_view words, Column<Values> column) {
  column.missing_if = words;
  return column;
}

/// The observed time of a point, as observers see it when it begins.
struct ObservedSpan {
  const Scene& scene;
  double total = 0.0;           ///< its length in tau
  double turns = 0.0;           ///< its length in forcing periods; without forcing in 2 pi
  double base_frequency = 0.0;  ///< of harmonics
  double base_turns = 0.0;      ///< turns of the base frequency in it
  double uncertainty = 0.0;     ///< of displacements: rounding, and after a repeat its tolerance (`uncertainty_of`)
  double theta = 0.0;           ///< forcing phase at its beginning, as the scene gives it, rad
  bool periodic = false;        ///< it is a period of the motion
  bool transient = false;       ///< it begins at the start of the scene
  bool undecided = false;       ///< whether the motion has a period isn't known
  bool stands_still = false;    ///< nothing moves any more
  const FourierScratch* fourier = nullptr;  ///< for harmonics from samples
  std::optional<FrameMotion> frame{};       ///< of observed motion less computed motion, if something is shaken
  int frame_sign = 0;                       ///< that of the shaking in it, also where nothing is shaken
  const GivenScene* given = nullptr;        ///< if derivatives by its numbers are asked for, in the units below
  Units units{};

  /// Whether it is a whole number of forcing periods, as the sums of harmonics and sections in lanes need.
  [[nodiscard]] bool has_whole_turns() const { return std::abs(turns - std::round(turns)) <= 1e-9; }
  /// Whether it counts as one period of its own: a transient, and a period of free motion.
  [[nodiscard]] bool counts_as_one_period() const { return transient || (!is_driven(scene.oscillator) && periodic); }
};

}  // namespace clatter::observables

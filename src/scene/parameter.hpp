#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/parameter_table.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

template <class Number>
inline constexpr auto table = parameter_rows<Number>();

}  // namespace detail

/// A number of the scene that a sweep can vary and a branch follow: a row of the table of parameters.
class Parameter {
 public:
  /// Of a key of [scene] or [machine], whose value has no unit if it may be another quantity with one. A key that isn't
  /// in the table doesn't compile.
  consteval Parameter(const char* key) : row_(0) {
    while (detail::table<double>[row_].key != key) ++row_;
  }
  /// Of a key whose value is a quantity; empty if no parameter has that name.
  [[nodiscard]] static std::optional<Parameter> of(std::string_view key, Quantity written = Quantity::number);

  /// The number of its row.
  [[nodiscard]] constexpr std::size_t index() const { return row_; }
  /// Its row of the table.
  [[nodiscard]] constexpr const ParameterRow<double>& row() const { return detail::table<double>[row_]; }
  /// Its key, e.g. "nu".
  [[nodiscard]] constexpr std::string_view key() const { return row().key; }
  [[nodiscard]] constexpr Role role() const { return row().role; }
  [[nodiscard]] constexpr Side side() const { return row().side; }
  /// Whether it is one of a loose mass.
  [[nodiscard]] constexpr bool is_loose() const { return row().is_loose; }
  /// Whether its key sets a number of both stops.
  [[nodiscard]] constexpr bool is_of_both() const { return row().place_of_upper != nullptr; }
  /// Whether its key stands for that of another parameter, one of each stop.
  [[nodiscard]] constexpr bool stands_for(Parameter half) const {
    const std::string_view both = half.row().other;
    return !both.empty() && (both == key() || both == row().counterpart);
  }
  /// Whether it is a key of [scene], of [machine], or of both.
  [[nodiscard]] constexpr bool is_in(std::string_view section) const {
    return !(section == "machine" ? row().in_machine : row().in_scene).long_name.empty();
  }
  /// "damping ratio": the name of its axis in results.
  [[nodiscard]] constexpr std::string_view long_name(bool is_si) const {
    return (is_si && is_in("machine") ? row().in_machine : row().in_scene).long_name;
  }
  /// Whether it is of an even order of the force, which half a period later isn't its opposite.
  [[nodiscard]] constexpr bool is_of_even_order() const {
    return role() == Role::force_order && (key().back() - '0') % 2 == 0;
  }
  /// Whether a scene that is its own mirror image stays so if the parameter changes; a stiffness moves the equilibrium
  /// of a load.
  [[nodiscard]] constexpr bool keeps_symmetry() const {
    return side() == Side::none && role() != Role::load && role() != Role::loose_load && role() != Role::force_shape &&
           !is_of_even_order();
  }

  friend constexpr bool operator==(Parameter, Parameter) = default;

 private:
  friend struct AllParameters;

  constexpr explicit Parameter(std::size_t row) : row_(static_cast<std::uint8_t>(row)) {}

  std::uint8_t row_;
};

/// Some of the parameters, in the order of the table.
class ParameterSet {
 public:
  constexpr void insert(Parameter parameter) { rows_[parameter.index() / 64] |= bit_of(parameter); }
  [[nodiscard]] constexpr bool contains(Parameter parameter) const {
    return (rows_[parameter.index() / 64] & bit_of(parameter)) != 0;
  }
  [[nodiscard]] constexpr bool empty() const { return rows_ == std::array<std::uint64_t, 3>{}; }
  [[nodiscard]] std::vector<Parameter> list() const;

 private:
  [[nodiscard]] static constexpr std::uint64_t bit_of(Parameter parameter) {
    return std::uint64_t{1} << parameter.index() % 64;
  }

  static_assert(detail::table<double>.size() <= 192);
  std::array<std::uint64_t, 3> rows_{};  ///< a bit each
};

/// Sets a number of a scene. A key of both stops sets that of each; `xs` and `gap` place them at -|value| and +|value|.
template <class Number>
void set(BasicGivenScene<Number>& given, Parameter parameter, const Number& value) {
  using std::abs;
  const ParameterRow<Number>& row = detail::table<Number>[parameter.index()];
  const bool is_distance = parameter.is_of_both() && parameter.role() == Role::position;
  if (is_distance) {
    row.place(given) = -abs(value), row.place_of_upper(given) = abs(value);
    return;
  }
  row.place(given) = value;
  if (row.place_of_upper != nullptr) row.place_of_upper(given) = value;
}

/// Makes a parameter a variable of numbers that carry derivatives: those that it sets change with it, a key of both
/// stops with each of the two, whose places go apart. One that is infinite doesn't change.
template <class Dual>
void differentiate_by(BasicGivenScene<Dual>& given, Parameter parameter, std::size_t variable) {
  const ParameterRow<Dual>& row = detail::table<Dual>[parameter.index()];
  const auto vary = [variable](Dual& number, double slope) {
    if (is_finite(number)) number.slope[variable] = slope;
  };
  const bool is_distance = parameter.is_of_both() && parameter.role() == Role::position;
  vary(row.place(given), is_distance ? -1.0 : 1.0);
  if (row.place_of_upper != nullptr) vary(row.place_of_upper(given), 1.0);
}

/// The number that a parameter sets; of both stops that of the upper one.
[[nodiscard]] inline double value_of(const GivenScene& given, Parameter parameter) {
  GivenScene copy = given;
  const ParameterRow<double>& row = parameter.row();
  return (parameter.is_of_both() ? row.place_of_upper : row.place)(copy);
}

namespace detail {

template <std::size_t row, class Number, class Other>
void convert(BasicGivenScene<Other>& from, BasicGivenScene<Number>& to) {
  constexpr const ParameterRow<Other>& old = table<Other>[row];
  constexpr const ParameterRow<Number>& own = table<Number>[row];
  own.place(to) = Number(old.place(from));
  if (own.place_of_upper != nullptr) own.place_of_upper(to) = Number(old.place_of_upper(from));
}

}  // namespace detail

/// A given scene with numbers of another type.
template <class Number, class Other>
[[nodiscard]] BasicGivenScene<Number> with_numbers(const BasicGivenScene<Other>& given) {
  BasicGivenScene<Other> from = given;
  BasicGivenScene<Number> to;
  to.is_si = given.is_si, to.mean_force = Number(given.mean_force);
  to.oscillator.shape = with_numbers<Number>(given.oscillator.shape);
  [&]<std::size_t... row>(std::index_sequence<row...>) { (detail::convert<row>(from, to), ...); }
  (std::make_index_sequence<detail::table<Number>.size()>{});
  const auto laws = laws_of<Number>(to);
  const auto laws_of_other = laws_of<Other>(from);
  for (std::size_t i = 0; i < laws.size(); ++i) laws[i]->table = laws_of_other[i]->table;
  return to;
}

/// Every parameter, in the order of the table.
struct AllParameters {
  struct Iterator {
    std::size_t row;
    Parameter operator*() const { return Parameter(row); }
    Iterator& operator++() { return ++row, *this; }
    friend bool operator==(const Iterator&, const Iterator&) = default;
  };
  [[nodiscard]] Iterator begin() const { return {0}; }
  [[nodiscard]] Iterator end() const { return {detail::table<double>.size()}; }
};
inline constexpr AllParameters all_parameters{};

}  // namespace scene
}  // namespace clatter

#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "scene/parameter_row.hpp"
#include "scene/stop_rows.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

/// A text whose '#' are digits.
template <std::size_t size>
struct Numbered {
  std::array<char, size> letters{};

  constexpr Numbered(const char (&text)[size], char digit) {
    for (std::size_t i = 0; i < size; ++i) letters[i] = text[i] == '#' ? digit : text[i];
  }
  [[nodiscard]] constexpr std::string_view view() const { return {letters.data(), size - 1}; }
};

/// The texts of order j of a force.
template <char digit>
struct OrderTexts {
  static constexpr Numbered f{"f_#", digit};
  static constexpr Numbered force{"force_#", digit};
  static constexpr Numbered phase{"phase_#", digit};
  static constexpr Numbered beside_f{"f = 1.0\nf_# = 0.3\n", digit};
  static constexpr Numbered beside_force{
      "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nforce = 40.0\nfrequency = 25.0\nforce_# = 10.0\n", digit};
  static constexpr Numbered of_f{"amplitude of order # of the force: f_# sin(# (nu tau + phase) + phase_#)", digit};
  static constexpr Numbered of_force{"amplitude of order # of the force, a sine of # times its frequency", digit};
  static constexpr Numbered of_phase{"phase of order # of the force when that of the first is 0", digit};
  static constexpr Numbered f_name{"order # of the force over stiffness", digit};
  static constexpr Numbered force_name{"order # of the force", digit};
  static constexpr Numbered phase_name{"phase of order # of the force", digit};
};

}  // namespace detail

/// The rows of the orders of a force, two each.
template <class Number>
constexpr auto order_rows() {
  using namespace clatter::scene::detail;
  using enum Quantity;
  using Given = BasicGivenScene<Number>;
  using Row = ParameterRow<Number>;
  const auto rows_of = []<char digit>() {
    using Text = OrderTexts<digit>;
    constexpr std::size_t i = digit - '2';
    return std::array{
        Row{.key = Text::f.view(),
            .in_scene = {"0", "0.3", Text::of_f.view(), a_force, Text::f_name.view()},
            .counterpart = Text::force.view(),
            .role = Role::force_order,
            .place = [](BasicGivenScene<Number>& scene) -> Number& { return scene.orders[i].amplitude; }},
        Row{.key = Text::force.view(),
            .quantity = force,
            .in_machine = {"0", "10 N", Text::of_force.view(), forced, Text::force_name.view()},
            .counterpart = Text::f.view(),
            .role = Role::force_order,
            .place = [](BasicGivenScene<Number>& scene) -> Number& { return scene.orders[i].amplitude; }},
        Row{.key = Text::phase.view(),
            .quantity = angle,
            .in_scene = {"0", "0.5", Text::of_phase.view(), Text::beside_f.view(), Text::phase_name.view()},
            .in_machine = {"0", "0.5 rad", Text::of_phase.view(), Text::beside_force.view(), Text::phase_name.view()},
            .role = Role::force_order,
            .place = [](BasicGivenScene<Number>& scene) -> Number& { return scene.orders[i].phase; }}};
  };
  static_assert(std::tuple_size_v<decltype(Given::orders)> == 7);
  const std::array all{rows_of.template operator()<'2'>(), rows_of.template operator()<'3'>(),
                       rows_of.template operator()<'4'>(), rows_of.template operator()<'5'>(),
                       rows_of.template operator()<'6'>(), rows_of.template operator()<'7'>(),
                       rows_of.template operator()<'8'>()};
  std::array<Row, 21> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = all[i / 3][i % 3];
  return rows;
}

}  // namespace scene
}  // namespace clatter

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "math/number.hpp"

namespace clatter {
inline namespace scene {

/// The course of a force over its period: a sine, or one of pieces.
enum class Waveform : std::uint8_t { sine, square, pulse, triangle, trapezoid, sawtooth, half_sine };

/// Their names, in the order of Waveform.
inline constexpr std::array<std::string_view, 7> force_shapes{"sine",      "square",   "pulse",    "triangle",
                                                              "trapezoid", "sawtooth", "half-sine"};

/// Whether a waveform has a first part, of a share of the period that can be chosen.
[[nodiscard]] constexpr bool has_duty(Waveform waveform) {
  return waveform == Waveform::square || waveform == Waveform::pulse || waveform == Waveform::half_sine;
}

/// The shape s of a force f s(theta), theta = nu tau + phase, with -1 <= s <= 1.
template <class Number>
struct BasicForceShape {
  Waveform waveform = Waveform::sine;
  Number duty{0.5};   ///< share of the period of the first part of a square, a pulse or a half-sine, 0 < duty < 1
  Number rise{0.25};  ///< share of the period in which a trapezoid rises from -1 to 1, 0 < rise <= 1/2

  [[nodiscard]] constexpr bool is_sine() const { return waveform == Waveform::sine; }

  friend bool operator==(const BasicForceShape&, const BasicForceShape&) = default;
};
using ForceShape = BasicForceShape<double>;

/// A shape with numbers of another type, that hold those of its own.
template <class Number, class Other>
[[nodiscard]] BasicForceShape<Number> with_numbers(const BasicForceShape<Other>& shape) {
  return {shape.waveform, Number(shape.duty), Number(shape.rise)};
}

/// A piece of a shape, which begins at a phase, in turns, with s and ds/dtheta. On it s'' = -w^2 s with the w of the
/// shape: 0, but for a half-sine.
template <class Number>
struct ForcePiece {
  Number begin{}, value{}, slope{};
};

/// The pieces of a shape over a turn, in the order of their beginnings, which are the knots of the force. None of a
/// sine.
template <class Number>
struct ForcePieces {
  std::array<ForcePiece<Number>, 4> pieces{};
  std::size_t count = 0;

  [[nodiscard]] auto begin() const { return pieces.begin(); }
  [[nodiscard]] auto end() const { return pieces.begin() + static_cast<std::ptrdiff_t>(count); }
};

template <class Number>
[[nodiscard]] ForcePieces<Number> pieces_of(const BasicForceShape<Number>& shape) {
  const Number zero(0), one(1), turn = 2 * pi<Number>(), half = one / 2, quarter = one / 4;
  const Number &duty = shape.duty, &rise = shape.rise;
  switch (shape.waveform) {
    case Waveform::sine:
      return {};
    case Waveform::square:
      return {{{{zero, one, zero}, {duty, -one, zero}}}, 2};
    case Waveform::pulse:
      return {{{{zero, one, zero}, {duty, zero, zero}}}, 2};
    case Waveform::triangle:
      return {{{{quarter, one, -4 / turn}, {1 - quarter, -one, 4 / turn}}}, 2};
    case Waveform::trapezoid: {
      const Number up = 2 / (rise * turn), ramp = rise / 2;
      return {{{{ramp, one, zero}, {half - ramp, one, -up}, {half + ramp, -one, zero}, {1 - ramp, -one, up}}}, 4};
    }
    case Waveform::sawtooth:
      return {{{{zero, -one, 2 / turn}}}, 1};
    case Waveform::half_sine:
      return {{{{zero, zero, 1 / (2 * duty)}, {duty, zero, zero}}}, 2};
  }
  return {};
}

/// w of a shape: s'' = -w^2 s, by the phase, on each of its pieces.
template <class Number>
[[nodiscard]] Number swing_of(const BasicForceShape<Number>& shape) {
  if (shape.is_sine()) return Number(1);
  return shape.waveform == Waveform::half_sine ? Number(1 / (2 * shape.duty)) : Number(0);
}

/// Largest |ds/dtheta| within a piece.
template <class Number>
[[nodiscard]] Number steepest_of(const BasicForceShape<Number>& shape) {
  using std::abs;
  Number most(0);
  for (const ForcePiece<Number>& piece : pieces_of(shape))
    if (abs(piece.slope) > most) most = abs(piece.slope);
  return most;
}

/// Whether a level of friction holds a mass under a constant force at all phases of f s.
template <class Number>
[[nodiscard]] bool holds_throughout(const Number& level, const Number& constant, const Number& f,
                                    const BasicForceShape<Number>& shape) {
  const bool is_one_way = shape.waveform == Waveform::pulse || shape.waveform == Waveform::half_sine;  // 0 <= s <= 1
  const Number up = f > 0 ? f : Number(is_one_way ? Number(0) : Number(-f));
  const Number down = f > 0 ? Number(is_one_way ? Number(0) : f) : Number(-f);
  return level - constant >= up && level + constant >= down;
}

/// The distance from a knot, in turns, within which a phase is that of the knot, to rounding.
template <class Number>
[[nodiscard]] Number knot_rounding() {
  return 16 * epsilon<Number>();
}

/// s and ds/dtheta of a shape in pieces at a phase, in turns; on a knot those of the piece that begins there.
template <class Number>
[[nodiscard]] SineCosine<Number> shape_at(const BasicForceShape<Number>& shape, const Number& turns) {
  const ForcePieces<Number> all = pieces_of(shape);
  const Number at = part_of_turn(turns) + knot_rounding<Number>();
  const ForcePiece<Number>* piece = &all.pieces[all.count - 1];
  Number since = at + 1 - piece->begin;
  for (const ForcePiece<Number>& other : all)
    if (other.begin <= at) piece = &other, since = at - other.begin;
  if (const ForcePiece<Number>& first = all.pieces[0]; first.begin + 1 <= at)
    piece = &first, since = at - 1 - first.begin;
  since = since > 2 * knot_rounding<Number>() ? Number(since - knot_rounding<Number>()) : Number(0);
  if (shape.waveform == Waveform::half_sine && piece->slope != 0) {
    const auto [sine, cosine] = sine_cosine_of_turns(Number(since * piece->slope));
    return {sine, piece->slope * cosine};
  }
  return {piece->value + piece->slope * (2 * pi<Number>() * since), piece->slope};
}

/// Phase in turns, 0 ... 1, at which the force f s passes a value, on its way to a side, within a piece; nothing if it
/// never does, or only touches it.
template <class Number>
[[nodiscard]] std::optional<Number> phase_of_shape(const BasicForceShape<Number>& shape, const Number& f,
                                                   const Number& needed, bool rises) {
  using std::atan2, std::sqrt;
  const Number value = needed / f;
  const bool up = (f > 0) == rises;
  if (shape.waveform == Waveform::half_sine) {
    if (!(value > 0 && value < 1)) return std::nullopt;
    const Number turns = atan2(value, Number(sqrt((1 - value) * (1 + value)))) / (2 * pi<Number>());
    return (up ? turns : Number(Number(1) / 2 - turns)) * 2 * shape.duty;
  }
  const ForcePieces<Number> all = pieces_of(shape);
  for (std::size_t i = 0; i < all.count; ++i) {
    const ForcePiece<Number>& piece = all.pieces[i];
    if (piece.slope == 0 || (piece.slope > 0) != up) continue;
    const Number next = i + 1 < all.count ? all.pieces[i + 1].begin : Number(all.pieces[0].begin + 1);
    const Number length = next - piece.begin, since = (value - piece.value) / (piece.slope * 2 * pi<Number>());
    if (since > 0 && since < length) return part_of_turn(Number(piece.begin + since));
  }
  return std::nullopt;
}

/// The mean of s, which acts as a load.
[[nodiscard]] inline double mean_of(const ForceShape& shape) {
  switch (shape.waveform) {
    case Waveform::square:
      return 2 * shape.duty - 1;
    case Waveform::pulse:
      return shape.duty;
    case Waveform::half_sine:
      return 2 * shape.duty / pi<double>();
    default:
      return 0;
  }
}

/// Whether s(theta + pi) = -s(theta).
[[nodiscard]] inline bool is_odd_by_half(const ForceShape& shape) {
  switch (shape.waveform) {
    case Waveform::sine:
    case Waveform::triangle:
    case Waveform::trapezoid:
      return true;
    case Waveform::square:
      return shape.duty == 0.5;
    default:
      return false;
  }
}

}  // namespace scene
}  // namespace clatter

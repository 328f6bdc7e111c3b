#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "math/number.hpp"
#include "scene/force_orders.hpp"
#include "scene/force_table.hpp"

namespace clatter {
inline namespace scene {

/// The course of a force over its period: a sine, one of pieces, or a sum of sines.
enum class Waveform : std::uint8_t { sine, square, pulse, triangle, trapezoid, sawtooth, half_sine, table, orders };

/// The names of those that a key chooses, in the order of Waveform.
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
  const ForceTable* table{nullptr};  ///< of Waveform::table alone, one that is `kept`
  ForceOrders<Number> orders{};      ///< of Waveform::orders alone

  [[nodiscard]] constexpr bool is_sine() const { return waveform == Waveform::sine; }
  [[nodiscard]] constexpr bool has_orders() const { return waveform == Waveform::orders; }
  [[nodiscard]] constexpr bool is_in_pieces() const { return !is_sine() && !has_orders(); }

  friend bool operator==(const BasicForceShape&, const BasicForceShape&) = default;
};
using ForceShape = BasicForceShape<double>;

/// A shape with numbers of another type, that hold those of its own.
template <class Number, class Other>
[[nodiscard]] BasicForceShape<Number> with_numbers(const BasicForceShape<Other>& shape) {
  BasicForceShape<Number> same{shape.waveform, Number(shape.duty), Number(shape.rise), shape.table};
  for (std::size_t i = 0; i < same.orders.of.size(); ++i)
    same.orders.of[i] = {Number(shape.orders.of[i].in_phase), Number(shape.orders.of[i].quadrature)};
  return same;
}

/// A piece of a shape, which begins at a phase, in turns, with s and ds/dtheta. On it s'' = -w^2 s with the w of the
/// shape: 0, but for a half-sine.
template <class Number>
struct ForcePiece {
  Number begin{}, value{}, slope{};
};

/// The pieces of a shape over a turn, in the order of their beginnings, which are the knots of the force. None of
/// sines.
template <class Number>
class ForcePieces {
 public:
  explicit ForcePieces(const BasicForceShape<Number>& shape);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Number begin_of(std::size_t i) const {
    return table_ == nullptr ? few_[i].begin : Number(table_->knots()[i].turns);
  }
  /// The knot after a piece; of the last one in the next turn.
  [[nodiscard]] Number end_of(std::size_t i) const { return i + 1 < size_ ? begin_of(i + 1) : Number(begin_of(0) + 1); }
  [[nodiscard]] ForcePiece<Number> operator[](std::size_t i) const {
    if (table_ == nullptr) return few_[i];
    const auto& knots = table_->knots();
    const Number peak(table_->peak()), value = Number(knots[i].after) / peak,
                                       next = Number(knots[i + 1 < size_ ? i + 1 : 0].before) / peak,
                                       begin = begin_of(i);
    return {begin, value, (next - value) / (2 * pi<Number>() * (end_of(i) - begin))};
  }
  /// The piece that a phase of 0 ... 1 turns lies in, and how far; on a knot, to rounding, that which begins there.
  struct Place {
    std::size_t piece;
    Number since;
  };
  [[nodiscard]] Place at(const Number& turns) const;

 private:
  const ForceTable* table_;
  std::array<ForcePiece<Number>, 4> few_{};  ///< without a table
  std::size_t size_ = 0;
};

template <class Number>
ForcePieces<Number>::ForcePieces(const BasicForceShape<Number>& shape) : table_(shape.table) {
  const Number zero(0), one(1), turn = 2 * pi<Number>(), half = one / 2, quarter = one / 4;
  const Number &duty = shape.duty, &rise = shape.rise;
  const auto set = [this](const auto&... pieces) { few_ = {pieces...}, size_ = sizeof...(pieces); };
  using Piece = ForcePiece<Number>;
  switch (shape.waveform) {
    case Waveform::sine:
    case Waveform::orders:
      break;
    case Waveform::square:
      set(Piece{zero, one, zero}, Piece{duty, -one, zero});
      break;
    case Waveform::pulse:
      set(Piece{zero, one, zero}, Piece{duty, zero, zero});
      break;
    case Waveform::triangle:
      set(Piece{quarter, one, -4 / turn}, Piece{1 - quarter, -one, 4 / turn});
      break;
    case Waveform::trapezoid: {
      const Number up = 2 / (rise * turn), ramp = rise / 2;
      set(Piece{ramp, one, zero}, Piece{half - ramp, one, -up}, Piece{half + ramp, -one, zero},
          Piece{1 - ramp, -one, up});
      break;
    }
    case Waveform::sawtooth:
      set(Piece{zero, -one, 2 / turn});
      break;
    case Waveform::half_sine:
      set(Piece{zero, zero, 1 / (2 * duty)}, Piece{duty, zero, zero});
      break;
    case Waveform::table:
      size_ = table_->knots().size();
  }
}

/// The distance from a knot, in turns, within which a phase is that of the knot, to rounding.
template <class Number>
[[nodiscard]] Number knot_rounding() {
  return 16 * epsilon<Number>();
}

template <class Number>
auto ForcePieces<Number>::at(const Number& turns) const -> Place {
  const Number at = turns + knot_rounding<Number>();
  std::size_t after = 0, end = size_;  // the first knot behind
  while (after < end) {
    const std::size_t middle = (after + end) / 2;
    if (begin_of(middle) <= at)
      after = middle + 1;
    else
      end = middle;
  }
  Place place{after > 0 ? after - 1 : size_ - 1, Number(0)};
  place.since = at - begin_of(place.piece) + (after > 0 ? 0 : 1);
  if (const Number next = at - begin_of(0) - 1; next >= 0) place = {0, next};
  place.since = place.since > 2 * knot_rounding<Number>() ? Number(place.since - knot_rounding<Number>()) : Number(0);
  return place;
}

/// w of a shape: s'' = -w^2 s, by the phase, on each of its pieces, and of a sine; 1 of a sum of sines.
template <class Number>
[[nodiscard]] Number swing_of(const BasicForceShape<Number>& shape) {
  if (!shape.is_in_pieces()) return Number(1);
  return shape.waveform == Waveform::half_sine ? Number(1 / (2 * shape.duty)) : Number(0);
}

/// Bound of |ds/dtheta| within a piece.
template <class Number>
[[nodiscard]] Number steepest_of(const BasicForceShape<Number>& shape) {
  using std::abs;
  if (shape.table != nullptr) return Number(shape.table->steepest());
  if (shape.has_orders()) return shape.orders.most_of(1);
  const ForcePieces<Number> pieces(shape);
  Number most(0);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (abs(pieces[i].slope) > most) most = abs(pieces[i].slope);
  return most;
}

/// Whether a level of friction holds a mass under a constant force at all phases of f s.
template <class Number>
[[nodiscard]] bool holds_throughout(const Number& level, const Number& constant, const Number& f,
                                    const BasicForceShape<Number>& shape) {
  const bool is_one_way = shape.waveform == Waveform::pulse || shape.waveform == Waveform::half_sine;
  const Number least(shape.table != nullptr ? shape.table->least()
                     : is_one_way           ? 0.0
                                            : -1.0),
      most(shape.table != nullptr ? shape.table->most() : 1.0);
  const Number up = f > 0 ? Number(f * most) : Number(f * least), down = f > 0 ? Number(f * least) : Number(f * most);
  return level - constant >= up && level + constant >= -down;
}

/// s and ds/dtheta of a shape in pieces at a phase, in turns; on a knot those of the piece that begins there.
template <class Number>
[[nodiscard]] SineCosine<Number> shape_at(const BasicForceShape<Number>& shape, const Number& turns) {
  const ForcePieces<Number> pieces(shape);
  const auto [i, since] = pieces.at(part_of_turn(turns));
  const ForcePiece<Number> piece = pieces[i];
  if (shape.waveform == Waveform::half_sine && piece.slope != 0) {
    const auto [sine, cosine] = sine_cosine_of_turns(Number(since * piece.slope));
    return {sine, piece.slope * cosine};
  }
  return {piece.value + piece.slope * (2 * pi<Number>() * since), piece.slope};
}

/// Phase in turns, 0 ... 1, at which the force f s passes a value, on its way to a side, within the piece that a phase
/// lies in; nothing if it doesn't, or only touches it.
template <class Number>
[[nodiscard]] std::optional<Number> phase_of_shape(const BasicForceShape<Number>& shape, const Number& f,
                                                   const Number& needed, bool rises, const Number& from) {
  using std::atan2, std::sqrt;
  const Number value = needed / f;
  const bool up = (f > 0) == rises;
  const ForcePieces<Number> pieces(shape);
  const std::size_t i = pieces.at(part_of_turn(from)).piece;
  const ForcePiece<Number> piece = pieces[i];
  if (shape.waveform == Waveform::half_sine) {
    if (piece.slope == 0 || !(value > 0 && value < 1)) return std::nullopt;
    const Number turns = atan2(value, Number(sqrt((1 - value) * (1 + value)))) / (2 * pi<Number>());
    return (up ? turns : Number(Number(1) / 2 - turns)) * 2 * shape.duty;
  }
  if (piece.slope == 0 || (piece.slope > 0) != up) return std::nullopt;
  const Number length = pieces.end_of(i) - piece.begin,
               since = (value - piece.value) / (piece.slope * 2 * pi<Number>());
  if (!(since > 0 && since < length)) return std::nullopt;
  return part_of_turn(Number(piece.begin + since));
}

/// Whether the force jumps to a value, other than those of pieces without slope.
template <class Number>
[[nodiscard]] bool jumps_to(const BasicForceShape<Number>& shape, const Number& value) {
  if (shape.waveform == Waveform::sawtooth) return value == -1;
  if (shape.table == nullptr) return false;
  return std::ranges::any_of(shape.table->knots(), [&](const ForceTable::Knot& knot) {
    return knot.before != knot.after && value == Number(knot.after) / Number(shape.table->peak());
  });
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
    case Waveform::table:
      return shape.table->mean();
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
    case Waveform::table:
      return shape.table->is_odd_by_half();
    case Waveform::orders:
      for (std::size_t j = 2; j <= ForceOrders<double>::most; j += 2)
        if (shape.orders.size(j) != 0) return false;
      return true;
    default:
      return false;
  }
}

}  // namespace scene
}  // namespace clatter

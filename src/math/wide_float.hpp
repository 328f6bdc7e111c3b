#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace clatter {
inline namespace math {

/// A number of 50 decimal digits: a sign, a power of two, and 192 bits in three words. The results of + - * / are cut
/// off after them, which is an error of at most 2^-190, far below the 2^-167 that it promises as `FiftyDigits` does.
/// Sums and products take half of the time of that type, quotients and functions from a fifth to a twentieth.
class WideFloat {
 public:
  using Word = std::uint64_t;

  constexpr WideFloat() = default;
  template <class T>
  requires std::is_arithmetic_v<T> WideFloat(T value)
      : WideFloat(static_cast<double>(value), of_double) {}  // every int is a double
  /// 2^exponent times a fraction, given by its words, the most significant one first.
  WideFloat(Word first, Word second, Word third, int exponent)
      : WideFloat(normalized({joined(first, second), joined(third, 0)}, exponent, false)) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  explicit operator T() const { return static_cast<T>(rounded()); }

  [[nodiscard]] bool is_finite() const { return kind_ <= Kind::zero; }
  [[nodiscard]] bool is_nan() const { return kind_ == Kind::nan; }
  [[nodiscard]] bool is_negative() const { return negative_; }
  [[nodiscard]] int exponent() const { return exponent_; }  ///< its size is below 2^exponent, and at least half of that
  [[nodiscard]] WideFloat times_power_of_two(int power) const {
    WideFloat result = *this;
    if (kind_ == Kind::normal) result.exponent_ += power;
    return result;
  }
  /// The integer part, towards 0.
  [[nodiscard]] WideFloat whole_part() const {
    if (kind_ != Kind::normal || exponent_ >= bits) return *this;
    if (exponent_ <= 0) return 0;
    const auto kept = [](Word word, int count) {
      return count <= 0 ? 0 : count >= 64 ? word : word & ~(~Word{0} >> count);
    };
    WideFloat result = *this;
    result.second_ = kept(second_, exponent_ - 64), result.third_ = kept(third_, exponent_ - 128);
    result.first_ = kept(first_, exponent_);
    return result;
  }

  WideFloat operator-() const { return {first_, second_, third_, exponent_, !negative_, kind_}; }
  friend WideFloat operator+(const WideFloat& a, const WideFloat& b) {
    if (!are_normal(a, b)) return special_sum(a, b);
    return a.exponent_ < b.exponent_ ? sum(b, a, b.negative_, a.negative_) : sum(a, b, a.negative_, b.negative_);
  }
  friend WideFloat operator-(const WideFloat& a, const WideFloat& b) {
    if (!are_normal(a, b)) return special_sum(a, -b);
    return a.exponent_ < b.exponent_ ? sum(b, a, !b.negative_, a.negative_) : sum(a, b, a.negative_, !b.negative_);
  }
  friend WideFloat operator*(const WideFloat& a, const WideFloat& b) {
    return are_normal(a, b) ? product(a, b) : a.kept() * b.kept();
  }
  friend WideFloat operator/(const WideFloat& a, const WideFloat& b) {
    return are_normal(a, b) ? quotient(a, b) : a.kept() / b.kept();
  }
  WideFloat& operator+=(const WideFloat& other) { return *this = *this + other; }
  WideFloat& operator-=(const WideFloat& other) { return *this = *this - other; }
  WideFloat& operator*=(const WideFloat& other) { return *this = *this * other; }
  WideFloat& operator/=(const WideFloat& other) { return *this = *this / other; }

  friend std::partial_ordering operator<=>(const WideFloat& a, const WideFloat& b) {
    if (a.negative_ != b.negative_ || !are_normal(a, b)) return a.kept() <=> b.kept();
    const std::strong_ordering sizes = compare_sizes(a, b);
    return a.negative_ ? 0 <=> sizes : sizes;
  }
  friend constexpr bool operator==(const WideFloat& a, const WideFloat& b) {
    if (a.kind_ == Kind::zero && b.kind_ == Kind::zero) return true;
    return a.kind_ == b.kind_ && a.kind_ != Kind::nan && a.negative_ == b.negative_ && a.exponent_ == b.exponent_ &&
           a.first_ == b.first_ && a.second_ == b.second_ && a.third_ == b.third_;
  }

 private:
  enum class Kind : std::uint8_t { normal, zero, infinite, nan };
  enum OfDouble : std::uint8_t { of_double };
  __extension__ typedef unsigned __int128 TwoWords;
  static constexpr int bits = 192;
  static constexpr Word first_bit = Word{1} << 63;
  /// A fraction with another word behind it.
  struct Guarded {
    TwoWords high, low;
  };

  WideFloat(double value, OfDouble) : kind_(kind_of(value)), negative_(std::signbit(value)) {
    if (kind_ != Kind::normal) return;
    if (std::abs(value) < std::numeric_limits<double>::min()) {
      first_ = static_cast<Word>(std::ldexp(std::frexp(std::abs(value), &exponent_), 64));
      return;
    }
    const auto word = std::bit_cast<Word>(value);
    first_ = first_bit | word << 11, exponent_ = static_cast<int>(word >> 52 & 0x7ff) - 1022;
  }
  WideFloat(Word first, Word second, Word third, int exponent, bool negative, Kind kind = Kind::normal)
      : first_(first), second_(second), third_(third), exponent_(exponent), kind_(kind), negative_(negative) {}

  static Kind kind_of(double value) {
    if (value == 0) return Kind::zero;
    return std::isfinite(value) ? Kind::normal : std::isnan(value) ? Kind::nan : Kind::infinite;
  }
  static bool are_normal(const WideFloat& a, const WideFloat& b) {
    return (static_cast<int>(a.kind_) | static_cast<int>(b.kind_)) == 0;
  }
  /// A double of the same sign and kind.
  [[nodiscard]] double kept() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 4> of_kind{1.0, 0.0, infinity, std::numeric_limits<double>::quiet_NaN()};
    return std::copysign(of_kind[static_cast<std::size_t>(kind_)], negative_ ? -1.0 : 1.0);
  }
  /// The nearest double.
  [[nodiscard]] double rounded() const {
    if (kind_ != Kind::normal) return kept();
    const double fraction = static_cast<double>(first_ | ((second_ | third_) != 0 ? 1 : 0));
    const double value = negative_ ? -fraction : fraction;
    if (std::abs(exponent_) > 900) return std::ldexp(value, exponent_ - 64);
    return value * std::bit_cast<double>(static_cast<Word>(exponent_ - 64 + 1023) << 52);
  }

  static TwoWords joined(Word high, Word low) { return TwoWords{high} << 64 | low; }
  static Word high(TwoWords w) { return static_cast<Word>(w >> 64); }
  static Word low(TwoWords w) { return static_cast<Word>(w); }
  static TwoWords times(Word a, Word b) { return TwoWords{a} * b; }
  [[nodiscard]] Guarded guarded() const { return {joined(first_, second_), joined(third_, 0)}; }

  static std::strong_ordering compare_sizes(const WideFloat& a, const WideFloat& b) {
    if (a.exponent_ != b.exponent_) return a.exponent_ <=> b.exponent_;
    if (a.first_ != b.first_) return a.first_ <=> b.first_;
    return a.second_ != b.second_ ? a.second_ <=> b.second_ : a.third_ <=> b.third_;
  }

  /// 2^exponent times a fraction, of which the first bit needn't be set.
  static WideFloat normalized(Guarded w, int exponent, bool negative) {
    if (w.high == 0) w = {w.low, 0}, exponent -= 128;
    if (w.high == 0) return {};
    const int free = high(w.high) != 0 ? std::countl_zero(high(w.high)) : 64 + std::countl_zero(low(w.high));
    if (free > 0) w = {w.high << free | w.low >> (128 - free), w.low << free};
    return {high(w.high), low(w.high), high(w.low), exponent - free, negative};
  }

  static WideFloat special_sum(const WideFloat& a, const WideFloat& b) {
    if (a.kind_ == Kind::zero && b.kind_ == Kind::normal) return b;
    if (b.kind_ == Kind::zero && a.kind_ == Kind::normal) return a;
    return a.kept() + b.kept();
  }
  /// The sum of two numbers with these signs, of which the first has the larger power of two.
  static WideFloat sum(const WideFloat& a, const WideFloat& b, bool a_negative, bool b_negative) {
    const std::int64_t apart = std::int64_t{a.exponent_} - b.exponent_;
    const Guarded x = a.guarded();
    Guarded y = b.guarded();
    if (apart >= bits + 64)
      y = {0, 0};
    else if (const int shift = static_cast<int>(apart); shift >= 128)
      y = {0, y.high >> (shift - 128)};
    else if (shift > 0)
      y = {y.high >> shift, y.low >> shift | y.high << (128 - shift)};
    if (a_negative != b_negative) return difference(x, y, a.exponent_, a_negative);
    const TwoWords lows = x.low + y.low, highs = x.high + y.high + (lows < x.low ? 1 : 0);
    if (highs >= x.high) return {high(highs), low(highs), high(lows), a.exponent_, a_negative};
    const TwoWords half = highs >> 1;
    return {high(half) | first_bit, low(half), high(lows) >> 1 | low(highs) << 63, a.exponent_ + 1, a_negative};
  }
  /// The difference of two fractions, of which the first has this sign.
  static WideFloat difference(const Guarded& x, const Guarded& y, int exponent, bool negative) {
    const bool turns = x.high < y.high || (x.high == y.high && x.low < y.low);
    const Guarded &more = turns ? y : x, &less = turns ? x : y;
    const TwoWords borrow = more.low < less.low ? 1 : 0;
    return normalized({more.high - less.high - borrow, more.low - less.low}, exponent, negative != turns);
  }

  static WideFloat product(const WideFloat& a, const WideFloat& b) {
    const TwoWords p33 = times(a.third_, b.third_), p23 = times(a.second_, b.third_), p32 = times(a.third_, b.second_),
                   p13 = times(a.first_, b.third_), p22 = times(a.second_, b.second_), p31 = times(a.third_, b.first_),
                   p12 = times(a.first_, b.second_), p21 = times(a.second_, b.first_), p11 = times(a.first_, b.first_);
    // sums of words with the same place, from the least on
    const TwoWords c5 = TwoWords{high(p33)} + low(p23) + low(p32);
    const TwoWords c4 = TwoWords{high(c5)} + high(p23) + high(p32) + low(p13) + low(p22) + low(p31);
    const TwoWords c3 = TwoWords{high(c4)} + high(p13) + high(p22) + high(p31) + low(p12) + low(p21);
    const TwoWords c2 = TwoWords{high(c3)} + high(p12) + high(p21) + low(p11);
    const Word first = high(c2) + high(p11), second = low(c2), third = low(c3), fourth = low(c4);
    const int exponent = a.exponent_ + b.exponent_;
    const bool negative = a.negative_ != b.negative_;
    if ((first & first_bit) != 0) return {first, second, third, exponent, negative};
    return {first << 1 | second >> 63, second << 1 | third >> 63, third << 1 | fourth >> 63, exponent - 1, negative};
  }

  /// By long division, a word at a time (Knuth, The Art of Computer Programming, 4.3.1, algorithm D).
  static WideFloat quotient(const WideFloat& a, const WideFloat& b) {
    const Guarded divisor = b.guarded();
    Guarded left = a.guarded();
    const bool halves = left.high > divisor.high || (left.high == divisor.high && left.low >= divisor.low);
    if (halves) left = {left.high >> 1, left.low >> 1 | left.high << 127};
    const Word first = next_word(left, divisor), second = next_word(left, divisor), third = next_word(left, divisor);
    return {first, second, third, a.exponent_ - b.exponent_ + (halves ? 1 : 0), a.negative_ != b.negative_};
  }
  /// The next word of a quotient; its product with the divisor is taken from what is left, which moves up by a word.
  static Word next_word(Guarded& left, const Guarded& divisor) {
    const Word d1 = high(divisor.high), d2 = low(divisor.high), d3 = high(divisor.low);
    Word word = high(left.high) >= d1 ? ~Word{0} : low(left.high / d1);  // too large by 2 at most
    const TwoWords c3 = times(word, d3), c2 = times(word, d2) + high(c3), c1 = times(word, d1) + high(c2);
    const TwoWords taken_high = c1, taken_low = joined(low(c2), low(c3));
    bool is_negative = left.high < taken_high || (left.high == taken_high && left.low < taken_low);
    left.high -= taken_high + (left.low < taken_low ? 1 : 0), left.low -= taken_low;
    while (is_negative) {
      const TwoWords low_part = left.low + joined(d2, d3), more = TwoWords{d1} + (low_part < left.low ? 1 : 0);
      --word;
      left.low = low_part, left.high += more, is_negative = left.high >= more;
    }
    left = {left.high << 64 | left.low >> 64, left.low << 64};
    return word;
  }

  Word first_ = 0, second_ = 0, third_ = 0;  ///< of the fraction, the most significant one first; its first bit is set
  int exponent_ = 0;
  Kind kind_ = Kind::zero;
  bool negative_ = false;
};

[[nodiscard]] inline bool isfinite(const WideFloat& x) { return x.is_finite(); }
[[nodiscard]] inline bool isnan(const WideFloat& x) { return x.is_nan(); }
[[nodiscard]] inline WideFloat abs(const WideFloat& x) { return x.is_negative() ? -x : x; }
[[nodiscard]] inline WideFloat fma(const WideFloat& x, const WideFloat& y, const WideFloat& z) { return x * y + z; }
[[nodiscard]] inline WideFloat ldexp(const WideFloat& x, int power) { return x.times_power_of_two(power); }
[[nodiscard]] inline WideFloat floor(const WideFloat& x) {
  const WideFloat whole = x.whole_part();
  return whole > x ? whole - 1 : whole;
}

}  // namespace math
}  // namespace clatter

template <>
class std::numeric_limits<clatter::WideFloat> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true;
  static constexpr int digits = 168, digits10 = 50, max_digits10 = 53, radix = 2;
  static constexpr int min_exponent = std::numeric_limits<double>::min_exponent;
  static constexpr int max_exponent = std::numeric_limits<double>::max_exponent;
  static clatter::WideFloat epsilon() { return 0x1p-167; }
  static clatter::WideFloat min() { return std::numeric_limits<double>::min(); }
  static clatter::WideFloat max() { return std::numeric_limits<double>::max(); }
  static clatter::WideFloat lowest() { return -std::numeric_limits<double>::max(); }
  static clatter::WideFloat infinity() { return std::numeric_limits<double>::infinity(); }
  static clatter::WideFloat quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
};

#pragma once

#include <arb.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace verify {

/// Something that balls of the present precision are too wide to tell.
class Undecided : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The precision of all arithmetic of this thread, bits.
inline thread_local slong bits = 64;

/// A real number in a ball: a midpoint and a radius that holds every error made so far.
class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(int value) : Ball() { arb_set_si(x_, value); }    // NOLINT(google-explicit-constructor)
  Ball(double value) : Ball() { arb_set_d(x_, value); }  // NOLINT(google-explicit-constructor): exact
  explicit Ball(slong value) : Ball() { arb_set_si(x_, value); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  ~Ball() { arb_clear(x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }

  /// The decimal number that a text holds; false if it holds none.
  [[nodiscard]] static bool read(const std::string& text, Ball& number) {
    return arb_set_str(number.x_, text.c_str(), bits) == 0 && arb_is_finite(number.x_) != 0;
  }
  [[nodiscard]] static Ball copied(const arb_t number) {
    return made([&](arb_t z) { arb_set(z, number); });
  }
  void copy_to(arb_t number) const { arb_set(number, x_); }
  [[nodiscard]] static Ball pi() {
    return made([](arb_t z) { arb_const_pi(z, bits); });
  }
  /// All numbers from a's to b's.
  [[nodiscard]] static Ball hull(const Ball& a, const Ball& b) {
    return made([&](arb_t z) { arb_union(z, a.x_, b.x_, bits); });
  }
  /// All numbers from -radius to radius.
  [[nodiscard]] static Ball around_zero(const Ball& radius) {
    return made([&](arb_t z) { arb_get_abs_ubound_arf(arb_midref(z), radius.x_, bits), arb_set_interval_neg_pos(z); });
  }

  friend Ball operator+(const Ball& a, const Ball& b) {
    return made([&](arb_t z) { arb_add(z, a.x_, b.x_, bits); });
  }
  friend Ball operator-(const Ball& a, const Ball& b) {
    return made([&](arb_t z) { arb_sub(z, a.x_, b.x_, bits); });
  }
  friend Ball operator*(const Ball& a, const Ball& b) {
    return made([&](arb_t z) { arb_mul(z, a.x_, b.x_, bits); });
  }
  friend Ball operator/(const Ball& a, const Ball& b) {
    return made([&](arb_t z) { arb_div(z, a.x_, b.x_, bits); });
  }
  friend Ball operator-(const Ball& a) {
    return made([&](arb_t z) { arb_neg(z, a.x_); });
  }

  friend Ball abs(const Ball& a) {
    return made([&](arb_t z) { arb_abs(z, a.x_); });
  }
  friend Ball sqrt(const Ball& a) {
    return made([&](arb_t z) { arb_sqrt(z, a.x_, bits); });
  }
  friend Ball exp(const Ball& a) {
    return made([&](arb_t z) { arb_exp(z, a.x_, bits); });
  }
  friend Ball log(const Ball& a) {
    return made([&](arb_t z) { arb_log(z, a.x_, bits); });
  }
  friend Ball asin(const Ball& a) {
    return made([&](arb_t z) { arb_asin(z, a.x_, bits); });
  }
  friend std::pair<Ball, Ball> sin_cos(const Ball& a) {
    std::pair<Ball, Ball> y;
    arb_sin_cos(y.first.x_, y.second.x_, a.x_, bits);
    return y;
  }
  friend std::pair<Ball, Ball> sinh_cosh(const Ball& a) {
    std::pair<Ball, Ball> y;
    arb_sinh_cosh(y.first.x_, y.second.x_, a.x_, bits);
    return y;
  }

  /// Relations that hold for every number of the balls; false if they don't, or if that can't be told.
  friend bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.x_, b.x_) != 0; }
  friend bool operator>(const Ball& a, const Ball& b) { return arb_gt(a.x_, b.x_) != 0; }
  friend bool operator<=(const Ball& a, const Ball& b) { return arb_le(a.x_, b.x_) != 0; }
  [[nodiscard]] bool is_positive() const { return arb_is_positive(x_) != 0; }
  [[nodiscard]] bool is_negative() const { return arb_is_negative(x_) != 0; }
  [[nodiscard]] bool is_zero() const { return arb_is_zero(x_) != 0; }  ///< exactly
  [[nodiscard]] bool is_constant() const { return true; }              ///< it has no derivative
  [[nodiscard]] bool is_finite() const { return arb_is_finite(x_) != 0; }
  [[nodiscard]] bool overlaps(const Ball& other) const { return arb_overlaps(x_, other.x_) != 0; }
  /// Whether another ball lies inside this one and meets neither of its ends.
  [[nodiscard]] bool holds_inside(const Ball& other) const { return arb_contains_interior(x_, other.x_) != 0; }

  [[nodiscard]] Ball middle() const {
    return made([&](arb_t z) { arb_get_mid_arb(z, x_); });
  }
  [[nodiscard]] Ball lower() const {
    return made([&](arb_t z) { arb_get_lbound_arf(arb_midref(z), x_, bits); });
  }
  [[nodiscard]] Ball upper() const {
    return made([&](arb_t z) { arb_get_ubound_arf(arb_midref(z), x_, bits); });
  }
  /// The numbers of both balls, which have one in common.
  [[nodiscard]] Ball within(const Ball& other) const {
    Ball z;
    if (arb_intersection(z.x_, x_, other.x_, bits) == 0) throw Undecided("two enclosures have nothing in common");
    return z;
  }
  /// The whole number of all of the ball's, rounded down; throws Undecided if there are several.
  [[nodiscard]] slong floor() const {
    Ball z;
    arb_floor(z.x_, x_, bits);
    fmpz_t n;
    fmpz_init(n);
    const bool unique = arb_get_unique_fmpz(n, z.x_) != 0 && fmpz_fits_si(n) != 0;
    const slong value = unique ? fmpz_get_si(n) : 0;
    fmpz_clear(n);
    if (!unique) throw Undecided("a number of turns");
    return value;
  }

  /// The middle, for texts and for choices on which no proof depends.
  [[nodiscard]] double near() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// An upper bound of the radius.
  [[nodiscard]] double radius() const { return mag_get_d(arb_radref(x_)); }
  [[nodiscard]] std::string text(slong digits = 20) const {
    char* const raw = arb_get_str(x_, digits, ARB_STR_MORE);
    std::string text = raw;
    flint_free(raw);
    return text;
  }

 private:
  template <class Make>
  static Ball made(const Make& make) {
    Ball z;
    make(z.x_);
    return z;
  }
  /// From a midpoint r to the ball of all numbers from -r to r.
  static void arb_set_interval_neg_pos(arb_t z) {
    arf_get_mag(arb_radref(z), arb_midref(z));
    arf_zero(arb_midref(z));
  }

  arb_t x_;
};

inline Ball square(const Ball& a) { return a * a; }
/// The one whose middle is smaller.
inline Ball smaller(const Ball& a, const Ball& b) { return a.near() <= b.near() ? a : b; }

/// Sets the precision of a thread for as long as it lives.
class Precision {
 public:
  explicit Precision(slong wanted) : before_(std::exchange(bits, wanted)) {}
  ~Precision() { bits = before_; }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

 private:
  slong before_;
};

}  // namespace verify

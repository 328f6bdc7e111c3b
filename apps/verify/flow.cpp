#include "flow.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace verify {
namespace {

/// k - h^2 with few relative errors however much it cancels.
template <class Number>
Number squared_rate(const Number& k, const Number& h) {
  const Precision more(2 * bits + 256);
  return k - h * h;
}

/// cos z^(1/2) and sin z^(1/2) / z^(1/2) by their series, for |z| <= 1.
template <class Number>
BasicVector<Number> near_zero(const Number& z) {
  Number term(1), cosine(0), sine(0);
  const int terms = static_cast<int>(bits / 4) + 8;
  for (int n = 0; n < terms; ++n) {  // term = (-z)^n / (2n)!
    cosine = cosine + term, sine = sine + term / Number(2 * n + 1);
    term = term * -z / Number((2 * n + 1) * (2 * n + 2));
  }
  const Number rest = Number::around_zero(Number(2) * term);  // of terms that fall faster than 2^-n
  return {cosine + rest, sine + rest};
}

}  // namespace

template <class Number>
BasicFlow<Number>::BasicFlow(const Number& h, const Number& k, const Number& load, const Scene& scene)
    : h_(h), k_(k), f_(scene.f), nu_(scene.nu), load_(load), phase_(scene.phase), lambda_squared_(squared_rate(k, h)) {
  sign_ = lambda_squared_.is_positive() ? 1 : lambda_squared_.is_negative() ? -1 : 0;
  if (sign_ != 0) lambda_ = sqrt(abs(lambda_squared_));
  const Number detuning = squared_rate(k, nu_);
  resonant_ = h.is_zero() && detuning.is_zero();
  if (!f_.is_zero() && !resonant_) {
    const Number quadrature = Number(2) * h * nu_, size = square(detuning) + square(quadrature);
    sine_part_ = f_ * detuning / size, cosine_part_ = -f_ * quadrature / size;
  }
  rate_ = std::max({std::sqrt(std::abs(k.near())), f_.is_zero() ? 0.0 : nu_.near(), 2 * h.near(), 1e-300});
}

template <class Number>
BasicVector<Number> BasicFlow<Number>::rotation(const Number& s) const {
  const Number decay = h_.is_zero() ? Number(1) : exp(-h_ * s);
  const Number z = lambda_squared_ * square(s);
  if (sign_ == 0 || abs(z) < Number(1) / Number(64)) {
    if (!(abs(z) <= Number(1))) throw Undecided("whether the damping is critical");
    const Vector y = near_zero(z);
    return {decay * y.x, decay * s * y.y};
  }
  const auto [sine, cosine] = sign_ > 0 ? sin_cos(lambda_ * s) : sinh_cosh(lambda_ * s);
  return {decay * cosine, decay * sine / lambda_};
}

template <class Number>
BasicFlow<Number>::Flight::Flight(const BasicFlow& flow, const Number& time, const Number& x, const Number& v)
    : flow_(flow), theta_(flow.nu_ * time + flow.phase_), free_{x, v} {
  Number sine, cosine;
  if (!flow.f_.is_zero()) std::tie(sine, cosine) = sin_cos(theta_);
  free_ = free_ - particular(Number(0), sine, cosine);
}

template <class Number>
BasicVector<Number> BasicFlow<Number>::Flight::particular(const Number& s, const Number& sine,
                                                          const Number& cosine) const {
  const BasicFlow& o = flow_;
  Vector y{Number(0), Number(0)};
  if (!o.f_.is_zero() && o.resonant_) {  // -f s cos(theta) / (2 nu)
    const Number half = o.f_ / Number(2);
    y = {-half * s * cosine / o.nu_, half * s * sine - half * cosine / o.nu_};
  } else if (!o.f_.is_zero()) {
    y = {o.sine_part_ * sine + o.cosine_part_ * cosine, o.nu_ * (o.sine_part_ * cosine - o.cosine_part_ * sine)};
  }
  if (o.load_.is_zero()) return y;
  if (!o.k_.is_zero()) return y + Vector{o.load_ / o.k_, Number(0)};
  if (o.h_.is_zero()) return y + Vector{o.load_ * square(s) / Number(2), o.load_ * s};
  const Number drift = o.load_ / (Number(2) * o.h_);
  return y + Vector{drift * s, drift};
}

template <class Number>
auto BasicFlow<Number>::Flight::at(const Number& s) const -> Instant {
  const BasicFlow& o = flow_;
  const Vector turn = o.rotation(s);
  const Number lean = o.h_ * turn.y;
  Number sine, cosine;
  if (!o.f_.is_zero()) std::tie(sine, cosine) = sin_cos(theta_ + o.nu_ * s);
  const Vector y = particular(s, sine, cosine);
  Instant now;
  now.x = y.x + (turn.x + lean) * free_.x + turn.y * free_.y;
  now.v = y.y - o.k_ * turn.y * free_.x + (turn.x - lean) * free_.y;
  const Number damping = Number(2) * o.h_;
  now.a = o.load_ - damping * now.v - o.k_ * now.x;
  if (!o.f_.is_zero()) now.a = now.a + o.f_ * sine;
  now.j = -damping * now.a - o.k_ * now.v;
  if (!o.f_.is_zero()) now.j = now.j + o.f_ * o.nu_ * cosine;
  now.d4 = -damping * now.j - o.k_ * now.a;
  if (!o.f_.is_zero()) now.d4 = now.d4 - o.f_ * square(o.nu_) * sine;
  return now;
}

template <class Number>
std::pair<Number, Number> BasicFlow<Number>::Flight::further(const Number& s, const Instant& there) const {
  const BasicFlow& o = flow_;
  const auto [sine, cosine] = sin_cos(theta_ + o.nu_ * s);
  const Number damping = Number(2) * o.h_, fast = o.f_ * o.nu_ * square(o.nu_);
  const Number d5 = -damping * there.d4 - o.k_ * there.j - fast * cosine;
  return {d5, -damping * d5 - o.k_ * there.d4 + fast * o.nu_ * sine};
}

template <class Number>
BasicMatrix<Number> BasicFlow<Number>::Flight::derivative(const Number& s) const {
  return flow_.propagator(s);
}

template <class Number>
BasicMatrix<Number> BasicFlow<Number>::propagator(const Number& s) const {
  const Vector turn = rotation(s);
  const Number lean = h_ * turn.y;
  return {turn.x + lean, turn.y, -k_ * turn.y, turn.x - lean};
}

template <class Number>
auto BasicFlow<Number>::response() const -> std::optional<Response> {
  if (resonant_ || f_.is_zero() || !(k_.is_positive() || k_.is_negative()) || !h_.is_positive()) return std::nullopt;
  const Number amplitude = sqrt(square(sine_part_) + square(cosine_part_));
  return Response{load_ / k_, amplitude, sine_part_, cosine_part_};
}

template class BasicFlow<Ball>;
template class BasicFlow<Dual>;

}  // namespace verify

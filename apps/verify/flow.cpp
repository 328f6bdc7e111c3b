#include "flow.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace verify {
namespace {

/// k - h^2 with few relative errors however much it cancels.
Ball squared_rate(const Ball& k, const Ball& h) {
  const Precision more(2 * bits + 256);
  return k - h * h;
}

/// cos z^(1/2) and sin z^(1/2) / z^(1/2) by their series, for |z| <= 1.
Vector near_zero(const Ball& z) {
  Ball term(1), cosine(0), sine(0);
  const int terms = static_cast<int>(bits / 4) + 8;
  for (int n = 0; n < terms; ++n) {  // term = (-z)^n / (2n)!
    cosine = cosine + term, sine = sine + term / Ball(2 * n + 1);
    term = term * -z / Ball((2 * n + 1) * (2 * n + 2));
  }
  const Ball rest = Ball::around_zero(Ball(2) * term);  // of a series whose terms fall faster than 2^-n
  return {cosine + rest, sine + rest};
}

}  // namespace

Flow::Flow(const Ball& h, const Ball& k, const Ball& load, const Scene& scene)
    : h_(h), k_(k), f_(scene.f), nu_(scene.nu), load_(load), phase_(scene.phase), lambda_squared_(squared_rate(k, h)) {
  sign_ = lambda_squared_.is_positive() ? 1 : lambda_squared_.is_negative() ? -1 : 0;
  if (sign_ != 0) lambda_ = sqrt(abs(lambda_squared_));
  const Ball detuning = squared_rate(k, nu_);
  resonant_ = h.is_zero() && detuning.is_zero();
  if (!f_.is_zero() && !resonant_) {
    const Ball quadrature = Ball(2) * h * nu_, size = square(detuning) + square(quadrature);
    sine_part_ = f_ * detuning / size, cosine_part_ = -f_ * quadrature / size;
  }
  rate_ = std::max({std::sqrt(std::abs(k.near())), f_.is_zero() ? 0.0 : nu_.near(), 2 * h.near(), 1e-300});
}

Vector Flow::rotation(const Ball& s) const {
  const Ball decay = h_.is_zero() ? Ball(1) : exp(-h_ * s);
  const Ball z = lambda_squared_ * square(s);
  if (sign_ == 0 || abs(z) < Ball(1.0 / 64)) {
    if (!(abs(z) <= Ball(1))) throw Undecided("whether the damping is critical");
    const Vector y = near_zero(z);
    return {decay * y.x, decay * s * y.y};
  }
  const auto [sine, cosine] = sign_ > 0 ? sin_cos(lambda_ * s) : sinh_cosh(lambda_ * s);
  return {decay * cosine, decay * sine / lambda_};
}

Flow::Flight::Flight(const Flow& flow, const Ball& time, const Ball& x, const Ball& v)
    : flow_(flow), theta_(flow.nu_ * time + flow.phase_), free_{x, v} {
  Ball sine, cosine;
  if (!flow.f_.is_zero()) std::tie(sine, cosine) = sin_cos(theta_);
  free_ = free_ - particular(Ball(0), sine, cosine);
}

Vector Flow::Flight::particular(const Ball& s, const Ball& sine, const Ball& cosine) const {
  const Flow& o = flow_;
  Vector y{Ball(0), Ball(0)};
  if (!o.f_.is_zero() && o.resonant_) {  // -f s cos(theta) / (2 nu)
    const Ball half = o.f_ / Ball(2);
    y = {-half * s * cosine / o.nu_, half * s * sine - half * cosine / o.nu_};
  } else if (!o.f_.is_zero()) {
    y = {o.sine_part_ * sine + o.cosine_part_ * cosine, o.nu_ * (o.sine_part_ * cosine - o.cosine_part_ * sine)};
  }
  if (o.load_.is_zero()) return y;
  if (!o.k_.is_zero()) return y + Vector{o.load_ / o.k_, Ball(0)};
  if (o.h_.is_zero()) return y + Vector{o.load_ * square(s) / Ball(2), o.load_ * s};
  const Ball drift = o.load_ / (Ball(2) * o.h_);
  return y + Vector{drift * s, drift};
}

Flow::Instant Flow::Flight::at(const Ball& s) const {
  const Flow& o = flow_;
  const Vector turn = o.rotation(s);
  const Ball lean = o.h_ * turn.y;
  Ball sine, cosine;
  if (!o.f_.is_zero()) std::tie(sine, cosine) = sin_cos(theta_ + o.nu_ * s);
  const Vector y = particular(s, sine, cosine);
  Instant now;
  now.x = y.x + (turn.x + lean) * free_.x + turn.y * free_.y;
  now.v = y.y - o.k_ * turn.y * free_.x + (turn.x - lean) * free_.y;
  const Ball damping = Ball(2) * o.h_;
  now.a = o.load_ - damping * now.v - o.k_ * now.x;
  if (!o.f_.is_zero()) now.a = now.a + o.f_ * sine;
  now.j = -damping * now.a - o.k_ * now.v;
  if (!o.f_.is_zero()) now.j = now.j + o.f_ * o.nu_ * cosine;
  now.d4 = -damping * now.j - o.k_ * now.a;
  if (!o.f_.is_zero()) now.d4 = now.d4 - o.f_ * square(o.nu_) * sine;
  return now;
}

Matrix Flow::Flight::derivative(const Ball& s) const { return flow_.propagator(s); }

Matrix Flow::propagator(const Ball& s) const {
  const Vector turn = rotation(s);
  const Ball lean = h_ * turn.y;
  return {turn.x + lean, turn.y, -k_ * turn.y, turn.x - lean};
}

std::optional<Flow::Response> Flow::response() const {
  if (resonant_ || f_.is_zero() || !(k_.is_positive() || k_.is_negative()) || !h_.is_positive()) return std::nullopt;
  const Ball amplitude = sqrt(square(sine_part_) + square(cosine_part_));
  return Response{load_ / k_, amplitude, sine_part_, cosine_part_};
}

}  // namespace verify

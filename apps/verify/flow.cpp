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
    : h_(h), k_(k), nu_(scene.nu), load_(load), phase_(scene.phase), lambda_squared_(squared_rate(k, h)) {
  sign_ = lambda_squared_.is_positive() ? 1 : lambda_squared_.is_negative() ? -1 : 0;
  if (sign_ != 0) lambda_ = sqrt(abs(lambda_squared_));
  for (const BasicOrder<Number>& order : scene.force.orders) parts_.push_back(part_of(order));
  rate_ = std::max({std::sqrt(std::abs(k.near())), scene.force.highest() * nu_.near(), 2 * h.near(), 1e-300});
}

template <class Number>
auto BasicFlow<Number>::part_of(const BasicOrder<Number>& order) const -> Part {
  Part part{order, Number(order.j) * nu_, false, Number(0), Number(0)};
  const Number detuning = squared_rate(k_, part.nu);
  part.resonant = h_.is_zero() && detuning.is_zero();
  if (part.resonant) return part;
  const Number resistance = Number(2) * h_ * part.nu, size = square(detuning) + square(resistance);
  const auto& [j, A, B] = order;
  part.sine = A * detuning / size, part.cosine = -A * resistance / size;
  if (!B.is_zero()) part.sine = part.sine + B * resistance / size, part.cosine = part.cosine + B * detuning / size;
  return part;
}

/// At resonance (B sin - A cos) s / (2 nu).
template <class Number>
BasicVector<Number> BasicFlow<Number>::Part::at(const Number& s, const Number& sine_then,
                                                const Number& cosine_then) const {
  if (!resonant) return {sine * sine_then + cosine * cosine_then, nu * (sine * cosine_then - cosine * sine_then)};
  const auto [value, turned] = force.template derivatives<2>(sine_then, cosine_then);
  const Number half = turned / Number(2 * force.j);  // half of A cos - B sin
  return {-half * s / nu, value * s / Number(2) - half / nu};
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
BasicVector<Number> BasicFlow<Number>::loaded(const Number& s) const {
  if (load_.is_zero()) return {Number(0), Number(0)};
  if (!k_.is_zero()) return {load_ / k_, Number(0)};
  if (h_.is_zero()) return {load_ * square(s) / Number(2), load_ * s};
  const Number drift = load_ / (Number(2) * h_);
  return {drift * s, drift};
}

template <class Number>
BasicFlow<Number>::Flight::Flight(const BasicFlow& flow, const Number& time, const Number& x, const Number& v)
    : flow_(flow), theta_(flow.nu_ * time + flow.phase_), free_{x, v} {
  free_ = free_ - driven(Number(0)).y;
}

template <class Number>
auto BasicFlow<Number>::Flight::driven(const Number& s) const -> Driven {
  const BasicFlow& o = flow_;
  Driven sum{{Number(0), Number(0)}, {Number(0), Number(0), Number(0)}};
  for (const Part& part : o.parts_) {
    const auto [sine, cosine] = sin_cos(Number(part.force.j) * (theta_ + o.nu_ * s));
    const auto [value, slope, bend] = part.force.template derivatives<3>(sine, cosine);
    sum.y = sum.y + part.at(s, sine, cosine);
    sum.force = {sum.force[0] + value, sum.force[1] + o.nu_ * slope, sum.force[2] + square(o.nu_) * bend};
  }
  sum.y = sum.y + o.loaded(s);
  return sum;
}

template <class Number>
auto BasicFlow<Number>::Flight::at(const Number& s) const -> Instant {
  const BasicFlow& o = flow_;
  const Vector turn = o.rotation(s);
  const Number lean = o.h_ * turn.y;
  const auto& [y, force] = driven(s);
  Instant now;
  now.x = y.x + (turn.x + lean) * free_.x + turn.y * free_.y;
  now.v = y.y - o.k_ * turn.y * free_.x + (turn.x - lean) * free_.y;
  const Number damping = Number(2) * o.h_;
  now.a = o.load_ - damping * now.v - o.k_ * now.x + force[0];
  now.j = -damping * now.a - o.k_ * now.v + force[1];
  now.d4 = -damping * now.j - o.k_ * now.a + force[2];
  return now;
}

template <class Number>
std::pair<Number, Number> BasicFlow<Number>::Flight::further(const Number& s, const Instant& there) const {
  const BasicFlow& o = flow_;
  Number third(0), fourth(0);  // derivatives of the force by the time
  for (const Part& part : o.parts_) {
    const auto [sine, cosine] = sin_cos(Number(part.force.j) * (theta_ + o.nu_ * s));
    const auto by_phase = part.force.template derivatives<5>(sine, cosine);
    third = third + o.nu_ * square(o.nu_) * by_phase[3], fourth = fourth + square(square(o.nu_)) * by_phase[4];
  }
  const Number damping = Number(2) * o.h_, d5 = -damping * there.d4 - o.k_ * there.j + third;
  return {d5, -damping * d5 - o.k_ * there.d4 + fourth};
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
  if (parts_.size() != 1 || parts_[0].force.j != 1 || parts_[0].resonant) return std::nullopt;
  if (!(k_.is_positive() || k_.is_negative()) || !h_.is_positive()) return std::nullopt;
  const auto& [sine, cosine] = std::tie(parts_[0].sine, parts_[0].cosine);
  return Response{load_ / k_, sqrt(square(sine) + square(cosine)), sine, cosine};
}

template class BasicFlow<Ball>;
template class BasicFlow<Dual>;

}  // namespace verify
